"""Aries, an external program: schedules for several robots with a short makespan. Start at `solver.Aries`."""
