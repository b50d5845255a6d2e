"""Simulated mobile bases: how they drive, what they carry, what they run into."""
