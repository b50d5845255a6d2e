"""Shapes: bodies, solids, boxes and outlines."""
