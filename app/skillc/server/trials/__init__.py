"""Trials: a task is run many times from the scene of a cell, one trial after the other, beside the cells."""
