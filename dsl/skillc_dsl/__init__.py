"""The skill language: source text, positions, syntax trees, diagnostics, formatting. Independent of robots and RDF.

Start at `parsing.parser.parse`; `syntax` has a dataclass for each construct.
"""
