"""Runs the tests of libraries on the world model alone; start with `suite`."""
