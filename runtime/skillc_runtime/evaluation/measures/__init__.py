"""The quality of each kind of work, from the simulation's ground truth: a module a kind, with results in `work`.

Start at `surfaces`.
"""
