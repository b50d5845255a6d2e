"""Joint motions that keep clear of what the world model knows to be there."""
