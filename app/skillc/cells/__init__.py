"""A running cell without a network: its operations, its journal, and the loop that owns it.

Start at `journal.journal`, what survives the process of a cell.
"""
