"""Diagnostics on their way to another process, as data: whoever shows them renders them."""

from __future__ import annotations

from skillc.contract.diagnosis import Diagnosis
from skillc.errors import ServiceError

MAX_DIAGNOSTICS, MAX_TEXT = 20, 20_000
"""How many diagnostics are passed on, and the length of the longest text."""


def diagnose(error: ServiceError) -> Diagnosis:
    """Return the diagnostics of an error, the first ones if there are many."""
    shown = tuple(error.diagnostics[:MAX_DIAGNOSTICS])
    paths = {span.path for each in shown for span in (each.span, *(label.span for label in each.labels))}
    known = {path: source.text for path, source in error.texts.items() if path in paths}
    return Diagnosis(shown, {path: text for path, text in known.items() if len(text) <= MAX_TEXT})
