"""Diagnostics as data: problems with places, causes and fixes."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Generic, Literal, TypeVar

from skillc_dsl.source import Span

T_co = TypeVar("T_co", covariant=True)
Severity = Literal["error", "warning"]


@dataclass(frozen=True, slots=True)
class Label:
    """A second place that explains the first, such as the contradicted declaration."""

    span: Span
    message: str


@dataclass(frozen=True, slots=True)
class Fix:
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
class Outcome(Generic[T_co]):
    """The result of a pass, with the diagnostics about what it had to leave out."""

    value: T_co
    diagnostics: tuple[Diagnostic, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether there is no error among the diagnostics."""
        return not any(d.severity == "error" for d in self.diagnostics)


def did_you_mean(wrong: str, candidates: Iterable[str]) -> str:
    """Return a help line with the candidates closest to `wrong`, or with all of them if they are few and none is close.

    Close candidates are spelt alike, or else contain `wrong`, as `ArmDevice` contains `Arm`.
    """
    names = sorted(set(candidates))
    near = difflib.get_close_matches(wrong, names, n=3, cutoff=0.6) or _holding(wrong, names)
    if near:
        return f"did you mean {' or '.join(f'`{name}`' for name in near)}?"
    if 0 < len(names) <= 8:
        return f"there is {', '.join(f'`{name}`' for name in names)}"
    return ""


def _holding(word: str, names: Iterable[str]) -> list[str]:
    """Return up to three names that contain `word`, of three letters or more; those that begin with it first."""
    small = word.lower()
    holding = [name for name in names if len(small) >= 3 and small in name.lower()]
    return sorted(holding, key=lambda name: (not name.lower().startswith(small), len(name), name))[:3]
