"""The skill language: text, positions, syntax trees, diagnostics. Knows no robots and no RDF."""
