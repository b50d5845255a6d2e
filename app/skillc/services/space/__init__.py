"""Looks at tasks and plans in space: whether the arms can carry them out, and what would help."""
