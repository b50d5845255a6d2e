"""Emitters: each prints the compiled library in one format, without further analysis."""
