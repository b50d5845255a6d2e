"""Primitive skills in Python: what the leaves of every tree do."""
