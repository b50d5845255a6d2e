"""What conditions say together: constants folded, effects, conjunctions, bounds, conflicts, subsumption.

Start with `conjunctions`: it splits a condition into the facts that the other modules compare.
"""
