"""Scenes and the Turtle they are written in."""
