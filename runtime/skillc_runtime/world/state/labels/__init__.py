"""Labelled facts and values, for recordings and messages."""
