"""A program whose names are resolved and values typed (`typed`), its types, and walks over it. Start with `typed`."""
