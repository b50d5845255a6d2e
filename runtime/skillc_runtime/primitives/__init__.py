"""Primitive skills in Python, which the leaves of a behaviour tree run.

Start with `primitive`, their life cycle, then `arm_motion`, the base class of motions.
"""
