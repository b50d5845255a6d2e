"""The literals that a condition, when it holds, makes true or false, each with its place."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from skillc_compiler.program.typed import Implementation, Program, Requirement, Skill, TypedCondition
from skillc_compiler.program.walk import clauses_in, steps
from skillc_model.conditions import And, Condition, Expression, Individual, Not, Or, Same, Variable
from skillc_model.rewriting import substitute


@dataclass(frozen=True, slots=True)
class Fact:
    """A condition without `and` and `not`, and whether it holds; `source` is what was written for that."""

    clause: TypedCondition
    holds: bool
    source: TypedCondition

    @property
    def meaning(self) -> Condition:
        """The condition that holds or not."""
        return self.clause.meaning


@dataclass(frozen=True, slots=True)
class ConjunctionGroup:
    """Facts that shall be true at the same time; of those `given` no problem is told again."""

    own: tuple[Fact, ...]
    given: tuple[Fact, ...] = ()


def conjuncts(clause: TypedCondition, holds: bool = True, source: TypedCondition | None = None) -> Iterator[Fact]:
    """Yield what certainly is the case when the condition holds, or when it does not."""
    match clause.meaning:
        case Not():
            yield from conjuncts(clause.parts[0], not holds, source or clause)
        case And() if holds:
            for part in clause.parts:
                yield from conjuncts(part)
        case Or() if not holds:
            for part in clause.parts:
                yield from conjuncts(part, holds=False, source=source)
        case _:
            yield Fact(clause, holds, source or clause)


def equal_names(requirements: Iterable[Requirement]) -> dict[str, Expression]:
    """Return for each name that preconditions say to be the same as another which of these stands for all of them."""
    facts = (fact for r in requirements if r.kind != "post" for fact in conjuncts(r.clause))
    return names_of(facts)


def names_of(facts: Iterable[Fact]) -> dict[str, Expression]:
    """Return for each name that facts say to be the same as another which of these stands for all of them."""
    names: dict[str, Expression] = {}
    for fact in facts:
        if fact.holds and isinstance(fact.meaning, Same):
            one, other = (substitute(each, names) for each in (fact.meaning.left, fact.meaning.right))
            one, other = (other, one) if isinstance(other, Variable) else (one, other)
            if isinstance(one, Variable) and isinstance(other, Variable | Individual) and one != other:
                names = {name: substitute(each, {one.name: other}) for name, each in names.items()}
                names[one.name] = other
    return names


def renamed(fact: Fact, names: Mapping[str, Expression]) -> Fact:
    """Return the fact with one name for all that are the same."""
    return replace(fact, clause=replace(fact.clause, meaning=substitute(fact.meaning, names))) if names else fact


def conjunction_groups(program: Program) -> Iterator[ConjunctionGroup]:
    """Yield every group of facts that a description, implementation, goal, node or part of a condition joins."""
    for skill in program.skills.values():
        yield ConjunctionGroup(_facts(skill.requirements))
    for implementation in program.implementations:
        yield ConjunctionGroup(_facts(implementation.requirements), _facts(implementation.skill.requirements))
    alone = [task.goal for task in program.tasks if task.goal]
    alone += [clause for step in steps(program) for clause in step.clauses]
    for clause in alone:
        yield ConjunctionGroup(tuple(conjuncts(clause)))
    for clause in (*alone, *_conditions(program)):
        yield from _inner(clause)


def _conditions(program: Program) -> Iterator[TypedCondition]:
    owners: tuple[Skill | Implementation, ...] = (*program.skills.values(), *program.implementations)
    for owner in owners:
        yield from (requirement.clause for requirement in owner.requirements)


def _facts(requirements: tuple[Requirement, ...]) -> tuple[Fact, ...]:
    return tuple(fact for r in requirements if r.kind != "post" for fact in conjuncts(r.clause))


def _inner(clause: TypedCondition) -> Iterator[ConjunctionGroup]:
    """Yield the groups inside `or` and quantifiers."""
    for part in clauses_in(clause):
        if not isinstance(part.meaning, And | Not):
            for below in part.parts:
                yield ConjunctionGroup(tuple(conjuncts(below)))
