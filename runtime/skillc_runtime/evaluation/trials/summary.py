"""The sentences about a series of trials, for the terminal and for its page."""

from __future__ import annotations

from skillc_runtime.evaluation.trials.series import Series
from skillc_runtime.recording.known_facts import UNVERIFIED


def format_false_successes(series: Series) -> str:
    """Return how many trials succeeded with a false claim; empty if none did."""
    if not series.false_successes:
        return ""
    return f"{series.false_successes} of {series.done} succeeded with a false claim"


def format_unverified(series: Series) -> str:
    """Return how many trials finished without being verified, and why; empty if all were verified."""
    if not series.unverified:
        return ""
    return f"{series.unverified} of {series.done} {UNVERIFIED}: only assumed: {'; '.join(series.assumed)}"
