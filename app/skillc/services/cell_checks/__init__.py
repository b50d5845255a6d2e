"""What cannot be simulated, reached, grasped or supported in a cell, as far as its facts say: one file a check.

Start with `check_cell` in `checks`. A violation is as severe as it is for a task that uses its individuals.
"""
