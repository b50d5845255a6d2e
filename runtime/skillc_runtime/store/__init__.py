"""Where a world outlives its process, and where several processes share it."""
