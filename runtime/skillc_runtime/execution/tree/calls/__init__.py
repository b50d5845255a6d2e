"""Calls of skills: selection, locks, effects, failures, undo."""
