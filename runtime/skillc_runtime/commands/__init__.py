"""The command line: one file a command, found by its name; the only place where compiler and runtime meet."""
