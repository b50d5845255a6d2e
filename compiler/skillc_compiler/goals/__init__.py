"""Parsing and checking of goals and calls given at run time. Start at `parsing`."""
