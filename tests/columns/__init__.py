"""Random worlds in which planner, world model and execution do what the text of a library says."""
