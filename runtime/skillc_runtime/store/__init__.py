"""Persistent stores of a world, which several processes can share: in a folder or on a SPARQL server.

Start at `opening`; `disk` and `sparql` are the two stores, `world_from_triples` builds the world from a store.
"""
