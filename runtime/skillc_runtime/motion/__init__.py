"""References for the tool as pure functions of time: poses, segments, paths, overlays, lanes."""
