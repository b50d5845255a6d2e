"""What is known about the world.

`state` is the facts and how they change, `eval` evaluates conditions and expressions, `space` is poses, sizes and
spatial relations, `places` are the functions that skill texts call. Start at `state.world_state`.
"""
