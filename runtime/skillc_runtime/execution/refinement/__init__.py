"""A dry run of a body in space: whether arms get where its primitives need them, by kinematics alone.

Start with `plan_refinement`; `walk` goes through a body, `needs` looks for what one primitive needs.
"""
