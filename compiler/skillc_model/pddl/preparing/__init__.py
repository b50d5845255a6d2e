"""Rewrites planning problems for planners that take each case of a condition as an action of its own."""
