"""Ontologies and scenes of others as they are published, from a local checkout: `make ontologies DIR=..`."""
