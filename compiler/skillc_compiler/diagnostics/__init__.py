"""The diagnostics that an author sees: consequences of other mistakes are left out, suppression comments applied.

Start with `suppressions` for the comments of an author, and with `consequences` for what is left out.
"""
