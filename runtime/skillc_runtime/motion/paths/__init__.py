"""Paths, their segments and their profiles over time."""
