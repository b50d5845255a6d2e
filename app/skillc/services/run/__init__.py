"""Runs of tasks: in simulation, on real devices, recorded and reported."""
