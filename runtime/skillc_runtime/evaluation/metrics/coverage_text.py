"""The share of a surface that was wiped, as text."""

from __future__ import annotations

from math import floor


def format_coverage(share: float) -> str:
    """Return a share in percent, without the unit, rounded down: only a surface without a gap has 100.0."""
    return f"{floor(round(1000 * share, 6)) / 10:.1f}"
