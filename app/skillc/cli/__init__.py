"""The command line. Each module of `commands` is one command: it calls a service and prints the result.

Start at `main`, which finds the commands, and `command`, which turns results and errors into exit codes."""
