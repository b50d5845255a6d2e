"""Executes plans: bodies that run their steps, progress, and which steps have failed."""
