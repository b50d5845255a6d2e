"""Series of trials: where they run, and what is kept of each."""
