"""Scenes: Turtle files as the first version of a world, with all that is wrong with them. Start at `load`."""
