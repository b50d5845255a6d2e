"""The literals that a condition makes true or false if it holds, each with its place."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import msgspec
from msgspec import structs

from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Implementation, Requirement, Skill
from skillc_compiler.program.walk import conditions_in
from skillc_model.conditions import And, Condition, Expression, Individual, Not, Or, Same, Term, Variable
from skillc_model.rewriting import substitute


class TypedFact(msgspec.Struct, frozen=True):
    """A condition without `and` and `not`, and whether it holds; `source` is the condition as written."""

    condition: TypedCondition
    holds: bool
    source: TypedCondition

    @property
    def meaning(self) -> Condition:
        """The condition that holds or does not hold."""
        return self.condition.meaning


class ConjunctionGroup(msgspec.Struct, frozen=True):
    """Facts that have to be true at the same time; problems among those `given` are not reported again."""

    own: tuple[TypedFact, ...]
    given: tuple[TypedFact, ...] = ()


def facts_in(
    condition: TypedCondition, holds: bool = True, source: TypedCondition | None = None
) -> Iterator[TypedFact]:
    """Yield the facts that are certain if the condition holds, or if it does not."""
    match condition.meaning:
        case _ if condition.is_effect:
            pass
        case Not():
            yield from facts_in(condition.parts[0], not holds, source or condition)
        case And() if holds:
            for part in condition.parts:
                yield from facts_in(part)
        case Or() if not holds:
            for part in condition.parts:
                yield from facts_in(part, holds=False, source=source)
        case _:
            yield TypedFact(condition, holds, source or condition)


def equal_names(requirements: Iterable[Requirement]) -> dict[str, Expression]:
    """Return, for each name that preconditions equate with another, the representative of its class of names."""
    facts = (fact for r in requirements if not r.says_what_comes for fact in facts_in(r.condition))
    return equal_names_in(facts)


def equal_names_in(facts: Iterable[TypedFact]) -> dict[str, Expression]:
    """Return, for each name that facts equate with another, the representative of its class of names."""
    names: dict[str, Variable | Individual] = {}
    for fact in facts:
        if fact.holds and isinstance(fact.meaning, Same):
            one, other = _representative(names, fact.meaning.left), _representative(names, fact.meaning.right)
            one, other = (other, one) if isinstance(other, Variable) else (one, other)
            if isinstance(one, Variable) and isinstance(other, Variable | Individual) and one != other:
                names[one.name] = other
    found = {name: _representative(names, other) for name, other in names.items()}
    return {name: other for name, other in found.items() if isinstance(other, Variable | Individual)}


def _representative(names: dict[str, Variable | Individual], thing: Term) -> Term:
    """Follow a name to the last one that it is equated with, and shorten the way there."""
    while isinstance(thing, Variable) and thing.name in names:
        above = names[thing.name]
        if isinstance(above, Variable):
            names[thing.name] = names.get(above.name, above)
        thing = above
    return thing


def rename_fact(fact: TypedFact, names: Mapping[str, Expression]) -> TypedFact:
    """Return the fact with equal names replaced by their representative."""
    if not names:
        return fact
    return structs.replace(fact, condition=structs.replace(fact.condition, meaning=substitute(fact.meaning, names)))


def conjunction_groups(program: Program) -> Iterator[ConjunctionGroup]:
    """Yield every group of facts that a description, implementation, goal, node or condition joins."""
    for skill in program.skills.values():
        yield ConjunctionGroup(_facts(skill.requirements))
    for implementation in program.implementations:
        yield ConjunctionGroup(_facts(implementation.requirements), _facts(implementation.skill.requirements))
    alone = [task.goal for task in program.tasks if task.goal]
    alone += [condition for task in program.tasks for condition in task.always]
    alone += [condition for node in program.nodes for condition in node.conditions]
    for condition in alone:
        yield ConjunctionGroup(tuple(facts_in(condition)))
    for condition in (*alone, *_conditions(program)):
        yield from _inner(condition)


def _conditions(program: Program) -> Iterator[TypedCondition]:
    owners: tuple[Skill | Implementation, ...] = (*program.skills.values(), *program.implementations)
    for owner in owners:
        yield from (requirement.condition for requirement in owner.requirements)


def _facts(requirements: tuple[Requirement, ...]) -> tuple[TypedFact, ...]:
    return tuple(fact for r in requirements if not r.says_what_comes for fact in facts_in(r.condition))


def _inner(condition: TypedCondition) -> Iterator[ConjunctionGroup]:
    """Yield the groups inside `or` and quantifiers."""
    for part in conditions_in(condition):
        if not isinstance(part.meaning, And | Not):
            for below in part.parts:
                yield ConjunctionGroup(tuple(facts_in(below)))
