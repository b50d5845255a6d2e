"""Loads scenes, Turtle files, as the first version of a world, and reports everything that is wrong with them.

`checks` has one file for each kind of mistake; `query` and `saving` are SPARQL and writing. Start at `load`.
"""
