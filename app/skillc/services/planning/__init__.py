"""Plans for the goal of a task."""
