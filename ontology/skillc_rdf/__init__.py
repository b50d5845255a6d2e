"""RDF with source positions: Turtle is read, edited and written with the place of each term; vocabularies are loaded.

Start at `turtle.parser.parse` for documents and at `vocabulary.load` for vocabularies.
"""
