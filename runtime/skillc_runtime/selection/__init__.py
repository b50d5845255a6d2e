"""Which implementation runs: what fits the arguments and the world, and why the others do not."""
