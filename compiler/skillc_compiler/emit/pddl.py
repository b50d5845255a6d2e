"""Emits domain.pddl and domain.temporal.pddl, the planning domains."""

from __future__ import annotations

from dataclasses import replace

from msgspec import structs

from skillc_model.pddl.domain import Action, PlanningDomain, Predicate, PropertyMeaning
from skillc_model.pddl.formulas import atoms
from skillc_model.pddl.planning import make_planning_domain
from skillc_model.pddl.text import format_domain, format_temporal_domain
from skillc_model.pddl.typed import action_terms
from skillc_model.skills import SkillLibrary


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


def emit(library: SkillLibrary) -> dict[str, str]:
    """Return the classical and the temporal domain."""
    domain = prune_unread_values(make_planning_domain(library))
    return {"domain.pddl": format_domain(domain), "domain.temporal.pddl": format_temporal_domain(domain)}
