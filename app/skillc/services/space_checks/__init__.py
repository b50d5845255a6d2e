"""Tasks looked at in space before they run: the step that does not go, and why."""
