"""What an author could add so that a finding goes away: it is tried before a message recommends it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import TypeAlias

from msgspec import structs

from skillc_compiler.analysis.binding import call_requirements, class_of, fresh_variable
from skillc_compiler.analysis.evaluate import evaluate
from skillc_compiler.analysis.exploration import Exploration
from skillc_compiler.analysis.findings import (
    Finding,
    Remedy,
    UndeclaredEffect,
    UnprovedPost,
    UnprovedPrecondition,
)
from skillc_compiler.analysis.initial_state import requirements_of
from skillc_compiler.analysis.paths import EndStates
from skillc_compiler.program.typed import Call, Implementation, TypedNode
from skillc_compiler.program.types import Thing
from skillc_compiler.program.walk import calls_in
from skillc_model.conditions import Condition, Expression, Holds, Not, Same, Variable
from skillc_model.rewriting import substitute
from skillc_model.traversal import conjuncts, free_variables
from skillc_rdf.vocabulary.types import THING

MOST_TRIED = 8
"""The number of findings in a body for which a remedy is looked for."""
_MOST_PAIRS = 15
_NONE = Remedy()

Explored: TypeAlias = tuple[Exploration, EndStates]
Assume: TypeAlias = Callable[[Remedy], Explored]
"""Explores a body again as if a remedy had been added to its skill."""


def add_remedies(
    run: Exploration, implementation: Implementation, found: Iterable[Finding], assume: Assume
) -> Iterator[Finding]:
    """Yield the findings, with a remedy where one is known to help."""
    left = MOST_TRIED
    for one in found:
        if left and isinstance(one, UnprovedPost | UnprovedPrecondition) and not one.false:
            left -= 1
            yield structs.replace(one, remedy=_find(run, implementation, one, assume))
        elif isinstance(one, UndeclaredEffect) and not one.missing and one.condition is not None:
            yield structs.replace(one, remedy=_declare(run, implementation, one, one.condition, assume))
        else:
            yield one


def _find(
    run: Exploration, implementation: Implementation, one: UnprovedPost | UnprovedPrecondition, assume: Assume
) -> Remedy | None:
    """Return the precondition, or the names that have to differ, without which the finding stays."""
    first = _NONE
    if isinstance(one, UnprovedPrecondition):
        named = _name(run, implementation, one.condition, is_post=False) if one.condition is not None else None
        if named is None:
            return None
        first = named
        if _helps(assume(first), one):
            return first
    apart = list(_pairs(implementation))
    if len(apart) > _MOST_PAIRS or not _helps(assume(_with(first, apart)), one):
        return None
    for each in tuple(apart):
        fewer = [other for other in apart if other is not each]
        if _helps(assume(_with(first, fewer)), one):
            apart = fewer
    return _with(first, apart)


def _declare(
    run: Exploration, implementation: Implementation, one: UndeclaredEffect, effect: Condition, assume: Assume
) -> Remedy | None:
    """Return what declares an effect; what the call finds by itself is passed if nothing else could be meant then."""
    named = _name(run, implementation, effect, is_post=True)
    if named is None:
        return None
    again, ends = assume(named)
    if ends.success and all(evaluate(again.types, state, each) for state in ends.success for each in named.after):
        return named
    fresh = {name.rstrip("'"): _parameter_name(name) for name in free_variables(effect) if "@" in name}
    values, names = _values(one.call, fresh), {*(each.name for each in implementation.parameters), *fresh.values()}
    needed = (substitute(each.condition.meaning, values) for each in call_requirements(run.program, one.call, "pre"))
    about = (each for each in needed if {*fresh.values()} & free_variables(each) and free_variables(each) <= names)
    before = dict.fromkeys((*named.before, *about))
    return structs.replace(named, before=tuple(before), passed=tuple(fresh.values()))


def _with(remedy: Remedy, apart: Sequence[Condition]) -> Remedy:
    return structs.replace(remedy, apart=tuple(apart))


def _pairs(implementation: Implementation) -> Iterator[Condition]:
    """Yield that two parameters are different individuals, for each two that may be the same."""
    things = [each.name for each in implementation.parameters if isinstance(each.type, Thing)]
    for left, right in combinations(things, 2):
        yield Not(Same(Variable(left), Variable(right)))


def _helps(explored: Explored, one: UnprovedPost | UnprovedPrecondition) -> bool:
    run, ends = explored
    if isinstance(one, UnprovedPost):
        return bool(ends.success) and all(
            evaluate(run.types, state, one.post.condition.meaning) for state in ends.success
        )
    left = (each for each in run.unproved_preconditions() if isinstance(each, UnprovedPrecondition))
    return not any(each.call is one.call and each.requirement is one.requirement for each in left)


def _name(run: Exploration, implementation: Implementation, condition: Condition, is_post: bool) -> Remedy | None:
    """Return what makes a condition sayable in the skill: parameters for what called skills find at run time."""
    own = {each.name: each for each in implementation.parameters}
    found = {name.rstrip("'"): name for name in free_variables(condition) if "@" in name}
    fresh = {name: _parameter_name(name) for name in found}
    if len(set(fresh.values())) < len(fresh) or any(
        name not in own and name not in found.values() for name in free_variables(condition)
    ):
        return None
    classes = {new: run.types.classes.get(name, THING) for name, new in fresh.items()}
    if THING in classes.values():  # what is found is a value, or may be anything
        return None
    if any(new in own and not run.types.vocabulary.is_a(class_of(own[new]), cls) for new, cls in classes.items()):
        return None
    said = substitute(condition, {found[name]: Variable(new) for name, new in fresh.items()})
    known = {each.condition.meaning for each in requirements_of(implementation, "pre")}
    links = dict.fromkeys(each for each in _links(run, implementation, fresh, own.keys()) if each not in known)
    parameters = tuple((new, cls) for new, cls in classes.items() if new not in own)
    if is_post:
        return Remedy(parameters, tuple(links), after=(said,))
    return Remedy(parameters, (*links, *((said,) if said not in known and said not in links else ())))


def _parameter_name(fresh: str) -> str:
    """Return the name of the parameter that the variable stands for, as in `Pick.robot@12:9`."""
    return fresh.partition("@")[0].rpartition(".")[2]


def _links(
    run: Exploration, implementation: Implementation, fresh: Mapping[str, str], own: Iterable[str]
) -> Iterator[Condition]:
    """Yield the relations by which called skills find these individuals, between names that the skill has or gets."""
    names = {*own, *fresh.values()}
    body = implementation.body
    for call in calls_in(body) if isinstance(body, TypedNode) else ():
        values = _values(call, fresh)
        asked = [each for each in (call.skill.requirements if call.skill else ()) if each.kind == "pre"]
        for fact in (fact for each in asked for fact in conjuncts(each.condition.meaning) if isinstance(fact, Holds)):
            said = substitute(fact, values)
            about = free_variables(said)
            if not run.types.is_computed(fact.relation) and about <= names and about & {*fresh.values()}:
                yield said


def _values(call: Call, fresh: Mapping[str, str]) -> dict[str, Expression]:
    """Return the values of a called skill's parameters, with new names for what it finds of these."""
    values: dict[str, Expression] = {each.name.text: each.value.meaning for each in call.arguments}
    for parameter in call.skill.parameters if call.skill else ():
        if parameter.name not in values:
            made = fresh_variable(call, parameter).name
            values[parameter.name] = Variable(fresh.get(made, made))
    return values
