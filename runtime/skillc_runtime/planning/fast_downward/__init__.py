"""Fast Downward, an external program: A* for optimal plans and LAMA for plans. Start at `solver.FastDownward`."""
