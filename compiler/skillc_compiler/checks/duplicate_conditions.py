"""A condition that is stated twice."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from skillc_compiler.logic.conjunctions import TypedFact, facts_in
from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Requirement
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_model.conditions import Condition

NAMES = ("duplicate-condition",)
NEEDS = Need.TYPES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each fact that is already stated in the same kind of condition."""
    for skill in program.skills.values():
        for kind in ("pre", "hold", "post"):
            yield from _find_duplicates(_facts(skill.requirements, kind), ())
    for implementation in program.implementations:
        for kind in ("pre", "hold", "post"):
            given = _facts(implementation.skill.requirements, kind)
            yield from _find_duplicates(_facts(implementation.requirements, kind), given)
    for condition in _single_conditions(program):
        yield from _find_duplicates(facts_in(condition), ())


def _single_conditions(program: Program) -> Iterator[TypedCondition]:
    yield from (task.goal for task in program.tasks if task.goal)
    for node in program.nodes:
        yield from node.conditions


def _facts(requirements: Iterable[Requirement], kind: str) -> list[TypedFact]:
    return [fact for r in requirements if r.kind == kind for fact in facts_in(r.condition)]


def _find_duplicates(facts: Iterable[TypedFact], given: Iterable[TypedFact]) -> Iterator[Diagnostic]:
    first: dict[tuple[Condition, bool], TypedFact] = {(fact.meaning, fact.holds): fact for fact in given}
    for fact in facts:
        former = first.setdefault((fact.meaning, fact.holds), fact)
        if former is not fact:
            yield Diagnostic(
                "duplicate-condition",
                fact.source.span,
                "this is stated already",
                help="remove one of the two",
                severity="warning",
                labels=(Label(former.source.span, "stated here"),),
            )
