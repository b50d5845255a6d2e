"""Primitive skills in Python, which the leaves of a tree run; `primitive` has their life cycle."""
