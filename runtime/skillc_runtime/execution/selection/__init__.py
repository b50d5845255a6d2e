"""Selects the implementation of a skill that runs, and explains why others do not.

Start reading at `select`; `preflight` checks a whole body before anything moves.
"""
