"""Functions over arrays in loops that run a thousand times a second: compiled where numba is installed."""
