"""Geometric reasoners, one file for each relation; vocabularies name them in `skillc:computedBy`."""
