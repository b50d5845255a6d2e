"""RDF formats: which one a text is in, its triples, and where it is about what.

Start at `read.read_triples`. Nothing is read from the network.
"""
