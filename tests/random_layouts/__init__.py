"""Random small layouts: stacks, crowds, narrow slots, shelves, two arms; start at `judging`."""
