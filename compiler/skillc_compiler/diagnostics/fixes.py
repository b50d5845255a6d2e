"""Tries the fixes of errors: one is offered only if there are fewer errors after it.

Errors of checks that need more than the fixed one are not counted: they may have been there, and not looked for.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache, partial
from types import MappingProxyType
from typing import TypeAlias

from skillc_compiler.checks import load_checks
from skillc_compiler.program.marks import Need
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.edits import apply_fixes, drop_overlapping
from skillc_dsl.source import Source

Check: TypeAlias = Callable[[Sequence[Source]], Iterable[Diagnostic]]
"""Returns the problems of other texts of the same files."""
Errors: TypeAlias = Counter[tuple[str, str]]
MOST_TRIED = 20
"""The maximum number of fixes that are tried; errors beyond them have none, as others are to be corrected first."""


def keep_useful_fixes(
    problems: Sequence[Diagnostic], sources: Sequence[Source], check: Check, some: Sequence[Diagnostic] | None = None
) -> tuple[Diagnostic, ...]:
    """Return the problems; an error has its fix only if there are fewer errors after it. Fixes of warnings stay.

    `some` of the problems are tried and returned, if not all.
    """
    kept = list(problems if some is None else some)
    fixable = [at for at, each in enumerate(kept) if each.severity == "error" and each.fix is not None]
    useful: set[int] = set()
    for need in Need:
        tried = {at: kept[at] for at in fixable[:MOST_TRIED] if _need(kept[at]) == need}
        useful.update(_useful(tried, _errors(problems, need), partial(_errors_after, sources, check, need)))
    dropped = set(fixable) - useful
    return tuple(replace(each, fix=None) if at in dropped else each for at, each in enumerate(kept))


def _useful(tried: Mapping[int, Diagnostic], before: Errors, after: Callable[[Sequence[Fix]], Errors]) -> Iterator[int]:
    """Yield the numbers of the errors whose fixes are useful; `after` returns the errors after some fixes.

    Most are, and each check takes as long as the first: they are tried together, and in smaller parts where that does
    not remove what they are of, or adds something else.
    """
    fixes = [problem.fix for problem in tried.values() if problem.fix is not None]
    numbers = list(tried)
    if len(fixes) == 1:
        yield from numbers if after(fixes).total() < before.total() else ()
        return
    parts = [numbers[: len(numbers) // 2], numbers[len(numbers) // 2 :]] if numbers else []
    if numbers and _are_apart(fixes):
        found = after(fixes)
        if found <= before - Counter(map(_error, tried.values())):
            yield from numbers
            return
        if stayed := [at for at in numbers if _error(tried[at]) in found]:
            parts = [[at for at in numbers if at not in stayed], *([at] for at in stayed)]
    for part in parts:
        yield from _useful({at: tried[at] for at in part}, before, after)


def _errors_after(sources: Sequence[Source], check: Check, most: Need, fixes: Sequence[Fix]) -> Errors:
    return _errors(check(_apply(fixes, sources)), most)


def _are_apart(fixes: Sequence[Fix]) -> bool:
    """Whether fixes can be applied together: no two of them touch, or are the same."""
    files = {fix.span.path for fix in fixes}
    return sum(len(drop_overlapping(fix for fix in fixes if fix.span.path == path)) for path in files) == len(fixes)


def _apply(fixes: Sequence[Fix], sources: Sequence[Source]) -> tuple[Source, ...]:
    changed = {fix.span.path for fix in fixes}
    return tuple(
        each._replace(text=apply_fixes(each.text, [fix for fix in fixes if fix.span.path == each.path]))
        if each.path in changed
        else each
        for each in sources
    )


def _errors(problems: Iterable[Diagnostic], most: Need) -> Errors:
    return Counter(_error(each) for each in problems if each.severity == "error" and _need(each) <= most)


def _error(problem: Diagnostic) -> tuple[str, str]:
    """Return what is wrong, wherever it is: places move when a text is changed."""
    return problem.name, problem.message


def _need(problem: Diagnostic) -> Need:
    """Return what the check that found a problem needs; names and syntax are looked at before all checks."""
    return _needs().get(problem.name, Need.NAMES)


@cache
def _needs() -> Mapping[str, Need]:
    return MappingProxyType({name: check.NEEDS for check in load_checks() for name in check.NAMES})
