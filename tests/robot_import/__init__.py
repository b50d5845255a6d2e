"""Arms are added to a project from URDF and MJCF files."""
