"""Sees dirt in images of a flat surface: functions of pixels, whoever took or rendered them."""
