"""The typed program: names resolved, expressions typed, with its types and iterators. Start with `typed`."""
