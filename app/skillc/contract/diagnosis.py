"""Diagnostics on their way to another process, as data: whoever shows them renders them."""

from __future__ import annotations

import msgspec

from skillc_dsl.diagnostics import Diagnostic


class Diagnosis(msgspec.Struct, frozen=True):
    """The errors of a request, and the texts that they point into, by path; long texts are left out."""

    diagnostics: tuple[Diagnostic, ...] = ()
    texts: dict[str, str] = {}

    def describe(self) -> str:
        """Return the diagnostics as text, one a line."""
        return "\n".join(map(str, self.diagnostics))


NO_DIAGNOSIS = Diagnosis()


class WorkRefused(msgspec.Struct, frozen=True):
    """Why a worker cannot do something; `why` is empty if a `diagnosis` says more."""

    why: str = ""
    diagnosis: Diagnosis = NO_DIAGNOSIS
