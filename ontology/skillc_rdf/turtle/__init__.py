"""Parses Turtle with the source span of every term, and reports syntax errors with fixes.

Other RDF parsers keep no positions and stop at the first error. This one keeps both ends of every term, recovers from
errors, and reads the same statements from a valid text. It depends neither on the skill language nor on the runtime.
Start at `parser.parse`.
"""
