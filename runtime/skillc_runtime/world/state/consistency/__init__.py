"""The axioms of a vocabulary: what follows from them, and what violates them."""
