"""Language servers for pages: one process for each WebSocket, which sees the texts of one library and nothing else."""
