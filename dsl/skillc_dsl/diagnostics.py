"""Diagnostics as data: problems with places, causes and fixes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, Literal, NamedTuple, TypeVar

from skillc_dsl.source import Span

T_co = TypeVar("T_co", covariant=True)
Severity = Literal["error", "warning", "note"]
"""A note is no problem: it says what was not looked at."""


class Label(NamedTuple):
    """A second place that explains the first, such as the contradicted declaration.

    `is_cause` if the mistake is there, however many problems it makes, unless something else uses it rightly.
    """

    span: Span
    message: str
    is_cause: bool = False


class Fix(NamedTuple):
    """An edit that fixes a problem: replace `span` by `text`; `message` describes it, as in `write `..``.

    `safe` if the edit is certainly what is meant, so that `check --fix` may apply it unasked; a guessed name or a
    deletion is not safe.
    """

    span: Span
    text: str
    message: str
    safe: bool = True


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """A problem with its name in kebab case.

    `message` describes the problem, `help` what to write instead; `fix` is the machine-applicable form of the help.
    """

    name: str
    span: Span
    message: str
    help: str = ""
    severity: Severity = "error"
    labels: tuple[Label, ...] = ()
    fix: Fix | None = None

    def __str__(self) -> str:
        where = f"{self.span.path}:{self.span.line}:{self.span.column}"
        return f"{where}: {self.message}" + (f" ({self.help})" if self.help else "")


@dataclass(frozen=True, slots=True)
class Misfit(Diagnostic):
    """A token that does not fit: `found` is the message without what would fit; `could_end` if a block could."""

    found: str = ""
    could_end: bool = False


@dataclass(frozen=True, slots=True)
class ForeignForm(Diagnostic):
    """A form of another language, which explains what else is wrong within its span."""


class Outcome(NamedTuple, Generic[T_co]):
    """The result of a pass, with the diagnostics about what it had to leave out."""

    value: T_co
    diagnostics: tuple[Diagnostic, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether there is no error among the diagnostics."""
        return not any(d.severity == "error" for d in self.diagnostics)
