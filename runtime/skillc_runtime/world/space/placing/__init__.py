"""Places: where a held thing can be put down, and why not."""
