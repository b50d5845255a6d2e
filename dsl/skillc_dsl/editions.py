"""The editions of the language: a library names one, and what came later changes nothing in it."""

from __future__ import annotations

from skillc_dsl.token_table import SINCE

EDITIONS = (1, 2)
"""The editions that exist, the oldest first. A `skillc.toml` that names none is of the first."""
FIRST, NEWEST = EDITIONS[0], EDITIONS[-1]


def list_later_words(edition: int) -> frozenset[str]:
    """Return the keywords that came after an edition."""
    return frozenset(word for word, since in SINCE.items() if since > edition)
