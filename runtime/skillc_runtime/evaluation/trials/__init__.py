"""Many runs of one task in realities that differ by their seeds: how good it is, and how sure."""
