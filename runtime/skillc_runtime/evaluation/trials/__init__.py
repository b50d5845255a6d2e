"""Many runs of one task in realities that differ by their seeds. Start at `experiment`, which runs one of them."""
