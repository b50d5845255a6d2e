"""The history of a run, made from its events."""
