"""Leaves out the actions that cannot help to reach a goal. The cheapest plan remains the cheapest plan.

A literal (a predicate with a sign) is *needed* if the goal or a condition of a helpful action reads it with that sign;
an action is *helpful* if it makes a needed literal true. Remove the unhelpful steps from a plan: by induction, every
needed literal that was true before a step is still true, because the removed steps made none of them true. So the rest
is a plan, and it costs no more.

A conditional effect may apply in only one of the two plans, so both signs of what its condition reads are needed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Set
from dataclasses import replace
from typing import TypeAlias, assert_never

import msgspec

from skillc_model.pddl.domain import Action, PlanningDomain
from skillc_model.pddl.formulas import (
    Atom,
    Change,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Universal,
    conjunction,
)
from skillc_model.pddl.typed import action_terms

Literal: TypeAlias = tuple[str, bool]


class RelevantDomain(msgspec.Struct, frozen=True):
    """The domain with the helpful actions only, and the skills that were left out."""

    domain: PlanningDomain
    unhelpful: tuple[str, ...]


def keep_relevant_actions(domain: PlanningDomain, goal: Formula) -> RelevantDomain:
    """Return the domain with the actions that can help to reach the goal, and the terms that these use."""
    needed = _find_needed(domain, goal)
    actions = tuple(each for each in domain.actions if _helps(each, needed))
    used = {atom.predicate for action in actions for atom in list_action_atoms(action)} | {name for name, _ in needed}
    functions = {each.name for each in domain.costs} & {name for action in actions for name in _cost_functions(action)}
    named = {name for action in actions for name in action_terms(action)}
    return RelevantDomain(
        replace(
            domain,
            actions=actions,
            predicates=tuple(each for each in domain.predicates if each.name in used),
            costs=tuple(each for each in domain.costs if each.name in functions),
            constants=tuple(each for each in domain.constants if each.name in named),
        ),
        tuple(sorted(_skills_of(domain.actions) - _skills_of(actions))),
    )


def _skills_of(actions: Iterable[Action]) -> Set[str]:
    return {each.skill for each in actions if each.skill is not None}


def list_action_atoms(action: Action) -> Iterator[Atom]:
    """Yield the atoms of an action's conditions and effects."""
    yield from (atom for _, atom in list_literals(conjunction((action.precondition, action.hold))))
    for change in action.effects:
        yield change.atom
        yield from (atom for _, atom in list_literals(change.condition))


def _find_needed(domain: PlanningDomain, goal: Formula) -> Set[Literal]:
    needed = {(atom.predicate, sign) for sign, atom in list_literals(goal)}
    while True:
        more = {each for action in domain.actions if _helps(action, needed) for each in _needs(action, needed)}
        if more <= needed:
            return needed
        needed |= more


def _helps(action: Action, needed: Set[Literal]) -> bool:
    return any((each.atom.predicate, each.positive) in needed for each in action.effects)


def _needs(action: Action, needed: Set[Literal]) -> Iterator[Literal]:
    for sign, atom in list_literals(conjunction((action.precondition, action.hold))):
        yield atom.predicate, sign
    for change in action.effects:
        touches = any((change.atom.predicate, sign) in needed for sign in (True, False))
        if touches and not _always_deletes(change):
            yield from ((atom.predicate, sign) for _, atom in list_literals(change.condition) for sign in (True, False))


def _always_deletes(change: Change) -> bool:
    """Whether the effect deletes its atom in every state."""
    return not change.positive and change.apart is not None


def _cost_functions(action: Action) -> Iterator[str]:
    function = getattr(action.cost, "function", None)
    if function is not None:
        yield function


def list_literals(formula: Formula) -> Iterator[tuple[bool, Atom]]:
    """Yield the atoms of a formula, each with its sign."""
    match formula:
        case Atom():
            yield True, formula
        case Negation(body):
            if isinstance(body, Atom):
                yield False, body
        case Equal():
            pass
        case Conjunction(parts) | Disjunction(parts):
            for part in parts:
                yield from list_literals(part)
        case Existential(_, body) | Universal(_, body):
            yield from list_literals(body)
        case _:
            assert_never(formula)
