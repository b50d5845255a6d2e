"""Reads vocabularies in Turtle into the terms that libraries speak of."""
