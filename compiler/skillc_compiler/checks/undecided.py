"""A body with more possible states than are told apart."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import TooManyStates
from skillc_compiler.analysis.proof import findings_of
from skillc_compiler.program.typed import Program
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("not-decided",)


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a note for each body that was followed only in part."""
    for one in findings_of(program, TooManyStates):
        yield Diagnostic(
            "not-decided",
            one.span,
            "this can end in more ways than are followed one by one, so what is told of it may be too careful",
            help="make skills of parts of it",
            severity="warning",
        )
