"""Lets planners know which things steps have moved: what did not go where a thing was may go where it is then."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from msgspec import structs

from skillc_model.pddl.domain import ROOT, Action, MovedMeaning, PlanningDomain, Predicate, RelationMeaning
from skillc_model.pddl.formulas import Atom, Change, Formula, Negation, Typed, conjunction
from skillc_model.pddl.names import make_unique
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.planning.plan import StepWhile
from skillc_runtime.world.state.terms import CONTAIN


def track_moves(domain: PlanningDomain, vocabulary: Vocabulary) -> tuple[PlanningDomain, str]:
    """Return a domain with a predicate of one thing, false at first, that is true once a step has moved it; its name.

    A thing is moved by an action that puts it into something else.
    """
    name = make_unique("moved", {*domain.names, *domain.predicate})
    moved = Predicate(name, (Typed("?thing", ROOT),), MovedMeaning(), changes=True)
    actions = tuple(_mark(each, name, domain, vocabulary) for each in domain.actions)
    return replace(domain, predicates=(*domain.predicates, moved), actions=actions), name


def describe_moved(excluded: StepWhile, moved: str) -> Formula:
    """Return which of the things (IRIs) that matter for a step have been moved, and which have not."""
    yet = (Negation(Atom(moved, (each,))) for each in excluded.unmoved)
    return conjunction((*yet, *(Atom(moved, (each,)) for each in excluded.moved)))


def _mark(action: Action, name: str, domain: PlanningDomain, vocabulary: Vocabulary) -> Action:
    things = dict.fromkeys(_list_moved(action, domain, vocabulary))
    return structs.replace(action, effects=(*action.effects, *(Change(Atom(name, (each,)), True) for each in things)))


def _list_moved(action: Action, domain: PlanningDomain, vocabulary: Vocabulary) -> Iterator[str]:
    """Yield the terms of what an action puts into something, unless it depends on more than its parameters."""
    inside = vocabulary.closure.canonical(CONTAIN)
    for change in action.effects:
        predicate = domain.predicate.get(change.atom.predicate)
        meaning = None if predicate is None else predicate.meaning
        if not isinstance(meaning, RelationMeaning) or not change.positive or change.variables:
            continue
        direction = vocabulary.closure.canonical(meaning.relation)
        if direction.relation == inside.relation:
            yield change.atom.terms[1 if direction.flipped == inside.flipped else 0]
