"""Ontologies as vocabularies."""
