"""From parsed files to a program: every name looked up, every value typed."""
