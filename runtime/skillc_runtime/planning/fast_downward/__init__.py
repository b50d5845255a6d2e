"""Fast Downward, a separate program: A* proves the optimum, LAMA finds plans. Start at `solver.FastDownward`."""
