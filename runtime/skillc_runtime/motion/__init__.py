"""Motions as pure functions of time: paths, profiles, overlays, and the references that follow them.

Start with `reference` (what a motion says at one instant), then `path` and `reference_generator`; `numerics` compiles.
"""
