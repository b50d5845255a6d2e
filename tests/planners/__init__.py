"""Planners, foreign and own: what they answer, and what happens when they fail."""
