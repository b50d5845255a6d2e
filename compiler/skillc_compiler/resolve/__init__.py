"""From parsed files to a program: every name is looked up, every expression typed. Start with `program`."""
