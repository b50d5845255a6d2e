"""Reads Turtle with the place of every term, and says in the author's words what is wrong with a text that is none.

RDF parsers keep no places and stop at the first mistake. This one keeps both ends of every term, goes on after a
mistake, and reads the same statements as they do from a text without one. It knows neither language nor runtime, so
that vocabularies, scenes and editors share it.
"""
