"""Loads ontologies into vocabularies: classes, relations and properties with their axioms, and diagnostics.

Start at `load.load`, then `types`, the result.
"""
