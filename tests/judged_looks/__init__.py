"""What looks in space say of random tasks, judged: a yes by a run with physics, a no by a search of its own."""
