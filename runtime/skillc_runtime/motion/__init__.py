"""Motions as pure functions of time: paths, profiles, overlays, and the generators of references along them.

Start with `reference` (a motion at one instant), then `path` and `reference_generator`. `numerics` compiles functions.
"""
