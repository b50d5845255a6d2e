"""The editions of the language: a library names one, and what came later changes nothing in it."""

from __future__ import annotations

EDITIONS = (1, 2)
"""The editions that exist, the oldest first. A `skillc.toml` that names none is of the first."""
FIRST, NEWEST = EDITIONS[0], EDITIONS[-1]
