"""Emitters: each prints the compiled library in one format, without further analysis.

Start at `artifacts.make_artifacts`, which finds the emitters and calls each.
"""
