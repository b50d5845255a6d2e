"""Cells without bodies, whose only state is the world model. Start with `cell.SymbolicCell`."""
