"""The axioms of ontologies by what becomes of them: applied to scenes, counted as used, without effect."""
