"""What calls in a body get of the skill around them, and what that takes over of the skills that it calls."""
