"""Random mistakes in libraries, and what the compiler reports: `python -m random_mistakes`, `make mistakes`."""
