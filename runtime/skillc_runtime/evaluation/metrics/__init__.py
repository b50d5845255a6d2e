"""Metrics of a skill, computed from the ground truth of a recording. Start at `wiping.measure_wiping`."""
