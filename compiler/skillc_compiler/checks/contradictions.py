"""Two conditions that cannot both hold."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.logic.conflicts import Conflicts
from skillc_compiler.logic.conjunctions import (
    ConjunctionGroup,
    TypedFact,
    conjunction_groups,
    equal_names_in,
    rename_fact,
)
from skillc_compiler.logic.related import RelatedFacts
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("contradicting-conditions",)
NEEDS = Need.TYPES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each fact that an earlier one excludes."""
    conflicts = Conflicts(program.vocabulary)
    for group in conjunction_groups(program):
        yield from _in_group(conflicts, group)


def _in_group(conflicts: Conflicts, group: ConjunctionGroup) -> Iterator[Diagnostic]:
    names = equal_names_in((*group.given, *group.own))
    earlier = RelatedFacts(conflicts)
    for given in group.given:
        earlier.add(rename_fact(given, names))
    own: set[object] = set()
    for fact in (rename_fact(each, names) for each in group.own):
        if (fact.meaning, fact.holds) in own:
            continue  # what contradicts it, contradicts the one before it
        against = earlier.first_excluding(fact)
        if against is not None:
            yield _problem(fact, against)
        earlier.add(fact)
        own.add((fact.meaning, fact.holds))


def _problem(fact: TypedFact, against: TypedFact) -> Diagnostic:
    return Diagnostic(
        "contradicting-conditions",
        fact.source.span,
        "this contradicts another condition, so they never hold together",
        help="keep one of the two, or join them with `or`",
        labels=(Label(against.source.span, "the other one"),),
    )
