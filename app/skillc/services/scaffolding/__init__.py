"""What `skillc new` and `skillc add` write: projects, scenes, and copies of shipped things."""
