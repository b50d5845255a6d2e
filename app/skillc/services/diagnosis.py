"""Diagnostics on their way to another process, as data: whoever shows them renders them."""

from __future__ import annotations

import msgspec

from skillc.services.errors import ServiceError
from skillc_dsl.diagnostics import Diagnostic

MAX_DIAGNOSTICS, MAX_TEXT = 20, 20_000
"""How many diagnostics are passed on, and the length of the longest text."""


class Diagnosis(msgspec.Struct, frozen=True):
    """The errors of a request, and the texts that they point into, by path; long texts are left out."""

    diagnostics: tuple[Diagnostic, ...] = ()
    texts: dict[str, str] = {}

    def describe(self) -> str:
        """Return the diagnostics as text, one a line."""
        return "\n".join(map(str, self.diagnostics))


NO_DIAGNOSIS = Diagnosis()


def diagnose(error: ServiceError) -> Diagnosis:
    """Return the diagnostics of an error, the first ones if there are many."""
    shown = tuple(error.diagnostics[:MAX_DIAGNOSTICS])
    paths = {span.path for each in shown for span in (each.span, *(label.span for label in each.labels))}
    known = {path: source.text for path, source in error.texts.items() if path in paths}
    return Diagnosis(shown, {path: text for path, text in known.items() if len(text) <= MAX_TEXT})
