"""Checks of libraries, tasks, scenes and projects, once, after each edit, and while files change."""
