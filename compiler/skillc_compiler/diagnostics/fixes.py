"""Tries the fixes of errors: one is offered only if there are fewer errors after it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import TypeAlias

from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.edits import apply_fixes
from skillc_dsl.source import Source

Check: TypeAlias = Callable[[Sequence[Source]], Iterable[Diagnostic]]
"""Returns the problems of other texts of the same files."""
MOST_TRIED = 20
"""The maximum number of fixes that are tried; errors beyond them have none, as others are to be corrected first."""


def keep_useful_fixes(
    problems: Sequence[Diagnostic], sources: Sequence[Source], check: Check
) -> tuple[Diagnostic, ...]:
    """Return the problems; an error has its fix only if there are fewer errors after it. Fixes of warnings stay."""
    before, tried = _count_errors(problems), 0
    kept = []
    for problem in problems:
        if problem.severity == "error" and problem.fix is not None:
            tried += 1
            if tried > MOST_TRIED or _count_errors(check(_apply(problem.fix, sources))) >= before:
                problem = replace(problem, fix=None)
        kept.append(problem)
    return tuple(kept)


def _apply(fix: Fix, sources: Sequence[Source]) -> tuple[Source, ...]:
    return tuple(
        replace(each, text=apply_fixes(each.text, [fix])) if each.path == fix.span.path else each for each in sources
    )


def _count_errors(problems: Iterable[Diagnostic]) -> int:
    return sum(problem.severity == "error" for problem in problems)
