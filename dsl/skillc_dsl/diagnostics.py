"""What the compiler reports to an author: problems as data, with places, causes and fixes."""

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
    """A second place that explains the first, such as the declaration that is contradicted."""

    span: Span
    message: str


@dataclass(frozen=True, slots=True)
class Fix:
    """An edit that fixes the problem: put `text` where `span` is; `message` says what it does, `write `..``.

    `safe` if nobody who sees the problem could mean something else, so that `check --fix` may apply it unasked; a guess
    at a name or a deletion of what was written is not.
    """

    span: Span
    text: str
    message: str
    safe: bool = True


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One problem, named in kebab case and described in the author's words.

    `message` says what is wrong, `help` what to type instead; `fix` is the machine-applicable form of the help.
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
    """What a pass understood, with everything it has to say about the rest."""

    value: T_co
    diagnostics: tuple[Diagnostic, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether there is no error among the diagnostics."""
        return not any(d.severity == "error" for d in self.diagnostics)


def did_you_mean(wrong: str, candidates: Iterable[str]) -> str:
    """Return a help line that names the candidates closest to `wrong`, or lists them all when few and none is close.

    Close are those spelt alike, or else those that hold `wrong` as a part, as `ArmDevice` holds `Arm`.
    """
    names = sorted(set(candidates))
    near = difflib.get_close_matches(wrong, names, n=3, cutoff=0.6) or _holding(wrong, names)
    if near:
        return f"did you mean {' or '.join(f'`{name}`' for name in near)}?"
    if 0 < len(names) <= 8:
        return f"there is {', '.join(f'`{name}`' for name in names)}"
    return ""


def _holding(word: str, names: Iterable[str]) -> list[str]:
    """Return up to three names that `word`, of three letters or more, is a part of: first those that begin with it."""
    small = word.lower()
    holding = [name for name in names if len(small) >= 3 and small in name.lower()]
    return sorted(holding, key=lambda name: (not name.lower().startswith(small), len(name), name))[:3]
