"""What the world can contain: vocabularies, robots, grippers, tools, fixtures and scenes as Turtle and MJCF.

Start at `catalogue`, which finds these files.
"""
