"""Implementations whose selection is ambiguous, or that are never selected."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_compiler.logic.conflicts import Conflicts
from skillc_compiler.logic.selection import (
    added_preconditions,
    can_both_fit,
    is_more_specific,
    rank_implementations,
    subsumes,
)
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Implementation
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("ambiguous-selection", "never-selected")
NEEDS = Need.BODY
READS = Reads.LIBRARY


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each implementation that an earlier one shadows or ties with."""
    conflicts = Conflicts(program.vocabulary)
    fixed = {(call.skill.name, call.implementation) for call in program.calls if call.skill}
    for declared in program.implementations_of.values():
        order = rank_implementations(program.vocabulary, declared)
        for place, implementation in enumerate(order):
            called = (implementation.skill.name, implementation.name) in fixed
            yield from _check_place(conflicts, implementation, order[:place], called)


def _check_place(
    conflicts: Conflicts, late: Implementation, before: Sequence[Implementation], called: bool
) -> Iterator[Diagnostic]:
    for early in before:
        shadowed = subsumes(conflicts.vocabulary, early, late) and added_preconditions(early) != added_preconditions(
            late
        )
        if shadowed and not called and "fallback" not in late.skill.flags:
            yield _never(late, early)
            return
        if not shadowed and _is_tied(conflicts, early, late):
            yield _ambiguous(late, early)
            return


def _is_tied(conflicts: Conflicts, early: Implementation, late: Implementation) -> bool:
    specific = is_more_specific(conflicts.vocabulary, early, late) or is_more_specific(
        conflicts.vocabulary, late, early
    )
    return early.prefer == late.prefer and not specific and can_both_fit(conflicts, early, late)


def _never(late: Implementation, early: Implementation) -> Diagnostic:
    return Diagnostic(
        "never-selected",
        late.name_span,
        f"`{late.name}` is never selected: `{early.name}` fits wherever it does, and is tried first",
        help=f"add `prefer {early.prefer + 1:g}` to `{late.name}`, or conditions to `{early.name}`",
        severity="warning",
        labels=(Label(early.name_span, "tried first"),),
    )


def _ambiguous(late: Implementation, early: Implementation) -> Diagnostic:
    return Diagnostic(
        "ambiguous-selection",
        late.name_span,
        f"`{late.name}` and `{early.name}` may both fit, and only their order decides that `{early.name}` is selected",
        help="add `prefer NUMBER` to the better one, or refine their parameters so that only one fits",
        severity="warning",
        labels=(Label(early.name_span, "the other one"),),
    )
