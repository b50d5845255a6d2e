"""Recordings that were made: how they are read, explained and drawn."""
