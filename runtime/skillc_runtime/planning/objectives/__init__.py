"""What a task asks of its plan besides the goal: what holds always, and little cost."""
