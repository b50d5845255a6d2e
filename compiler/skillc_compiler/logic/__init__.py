"""Reasoning about conditions without executing bodies: effects, facts, bounds, conflicts, selection.

Start with `conjunctions`: it splits a condition into the facts that the other modules compare.
"""
