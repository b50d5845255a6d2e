"""Removes from a domain the predicates of property values that no action reads.

A false `p` is then written `(not (p ..))`. A domain for a known goal keeps these predicates, since the goal may use
them.
"""

from __future__ import annotations

from dataclasses import replace

from msgspec import structs

from skillc_model.pddl.domain import Action, PlanningDomain, Predicate, PropertyMeaning
from skillc_model.pddl.formulas import atoms
from skillc_model.pddl.typed import action_terms


def prune_unread_values(domain: PlanningDomain) -> PlanningDomain:
    """Return the domain without unread predicates of values that are False or that no action adds."""
    read = {name for action in domain.actions for name in _read(action)}
    added = {change.atom.predicate for action in domain.actions for change in action.effects if change.positive}
    spare = {each.name for each in domain.predicates if each.name not in read and _is_spare(each, added)}
    actions = tuple(
        structs.replace(action, effects=tuple(each for each in action.effects if each.atom.predicate not in spare))
        for action in domain.actions
    )
    predicates = tuple(each for each in domain.predicates if each.name not in spare)
    used = frozenset().union(*(action_terms(each) for each in actions))
    constants = tuple(each for each in domain.constants if each.name in used)
    return replace(domain, predicates=predicates, actions=actions, constants=constants)


def _read(action: Action) -> set[str]:
    formulas = (action.precondition, action.hold, *(change.condition for change in action.effects))
    return {atom.predicate for formula in formulas for atom in atoms(formula)}


def _is_spare(predicate: Predicate, added: set[str]) -> bool:
    match predicate.meaning:
        case PropertyMeaning(value=value):
            return value is False or predicate.name not in added
    return False
