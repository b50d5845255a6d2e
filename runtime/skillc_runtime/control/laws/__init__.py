"""Control laws, and what they are computed from."""
