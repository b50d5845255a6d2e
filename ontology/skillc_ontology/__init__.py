"""What the world can contain: vocabularies, robots, grippers, tools and scenes as Turtle and MJCF."""
