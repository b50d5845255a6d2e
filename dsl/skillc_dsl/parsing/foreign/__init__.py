"""Forms of other languages, with what is written here instead.

Each table has regular expressions for a part of a line in which a token does not fit, the first that fits first.
"""
