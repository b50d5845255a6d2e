"""Tasks, goals and calls: how they are found, loaded and assigned to the world of a scene."""
