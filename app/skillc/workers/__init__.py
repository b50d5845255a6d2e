"""Processes that answer what takes long, or what nobody can foresee: they can be killed, and no cell waits for them.

`jobs` has what can be asked, `answering` the function that they run, `pool` the processes. Start with `pool`.
"""
