"""Simulated grippers: fingers, what they touch, and what they hold."""
