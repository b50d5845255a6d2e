"""RDF with source positions: `turtle` parses and edits documents, `vocabulary` loads ontologies into terms.

Start at `turtle.parser.parse` for documents and at `vocabulary.load` for vocabularies.
"""
