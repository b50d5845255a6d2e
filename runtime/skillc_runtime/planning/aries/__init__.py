"""The temporal planner aries, a program of its own: plans with several robots at once that are over early."""
