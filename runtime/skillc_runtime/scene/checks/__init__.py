"""What a scene must say beyond the axioms of its vocabulary: one file a check."""
