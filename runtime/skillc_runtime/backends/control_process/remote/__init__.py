"""A controlled arm as the process of the tree sees it."""
