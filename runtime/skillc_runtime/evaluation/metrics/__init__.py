"""How well a skill was done, computed from the ground truth of one recording. Start at `wiping.measure_wiping`."""
