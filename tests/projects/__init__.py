"""Projects: `skillc.toml`, the commands in it, and libraries that others import."""
