"""Emitters: each prints the compiled library in one form, and none derives meaning of its own."""
