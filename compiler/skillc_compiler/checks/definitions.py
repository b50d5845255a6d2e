"""A relation that is defined by its own negation."""

from __future__ import annotations

from collections.abc import Iterator, Set

from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_dsl.diagnostics import Diagnostic
from skillc_model.conditions import Holds, Not
from skillc_rdf.vocabulary.types import local_name

NAMES = ("negative-recursion",)
NEEDS = Need.NAMES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each negated relation of a definition that leads back to the relation that is defined."""
    for each in program.defined:
        known = program.vocabulary.definitions.get(each.iri)
        for part in _find_negated(each.condition, frozenset(known.group if known else ()), negated=False):
            yield Diagnostic(
                "negative-recursion",
                part.span,
                f"`{local_name(each.iri)}` would hold because it does not hold: this leads back to it, and is negated",
                help="a definition may lead back to itself without `not` only: define the opposite, or state the facts",
            )


def _find_negated(condition: TypedCondition, group: Set[str], *, negated: bool) -> Iterator[TypedCondition]:
    """Yield the relations of a group in a condition that are negated an odd number of times."""
    match condition.meaning:
        case Holds(relation=relation) if negated and relation in group:
            yield condition
        case Not():
            negated = not negated
    for part in condition.parts:
        yield from _find_negated(part, group, negated=negated)
