"""What happened: events as they occur, the log file they go to, and the tree with its outcomes afterwards."""
