"""Tries the fixes of errors: one is offered only if there are fewer errors after it.

Errors of checks that need more than the fixed one are not counted: they may have been there, and not looked for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from types import MappingProxyType
from typing import TypeAlias

from skillc_compiler.checks import load_checks
from skillc_compiler.program.marks import Need
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.edits import apply_fixes
from skillc_dsl.source import Source

Check: TypeAlias = Callable[[Sequence[Source]], Iterable[Diagnostic]]
"""Returns the problems of other texts of the same files."""
MOST_TRIED = 20
"""The maximum number of fixes that are tried; errors beyond them have none, as others are to be corrected first."""


def keep_useful_fixes(
    problems: Sequence[Diagnostic], sources: Sequence[Source], check: Check, some: Sequence[Diagnostic] | None = None
) -> tuple[Diagnostic, ...]:
    """Return the problems; an error has its fix only if there are fewer errors after it. Fixes of warnings stay.

    `some` of the problems are tried and returned, if not all.
    """
    tried, kept = 0, []
    for problem in problems if some is None else some:
        if problem.severity == "error" and problem.fix is not None:
            tried, need = tried + 1, _need(problem)
            before = _count_errors(problems, need)
            if tried > MOST_TRIED or _count_errors(check(_apply(problem.fix, sources)), need) >= before:
                problem = replace(problem, fix=None)
        kept.append(problem)
    return tuple(kept)


def _apply(fix: Fix, sources: Sequence[Source]) -> tuple[Source, ...]:
    return tuple(
        each._replace(text=apply_fixes(each.text, [fix])) if each.path == fix.span.path else each for each in sources
    )


def _count_errors(problems: Iterable[Diagnostic], most: Need) -> int:
    return sum(problem.severity == "error" and _need(problem) <= most for problem in problems)


def _need(problem: Diagnostic) -> Need:
    """Return what the check that found a problem needs; names and syntax are looked at before all checks."""
    return _needs().get(problem.name, Need.NAMES)


@cache
def _needs() -> Mapping[str, Need]:
    return MappingProxyType({name: check.NEEDS for check in load_checks() for name in check.NAMES})
