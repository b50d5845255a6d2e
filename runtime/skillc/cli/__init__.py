"""The command line: `commands` has a module for each command, which calls a service and prints its result."""
