"""Random surfaces before three arms: whether what a look in space says of wiping them is so; start at `judging`."""
