"""Finds the facts in which versions of the world differ, and the facts that a change determines."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_model.read_write import EVERYTHING, FactPattern
from skillc_runtime.world.state.changes import AddRelation, Change, ClearProperty, RemoveRelation, SetProperty
from skillc_runtime.world.state.world_state import WorldState


def find_changed_facts(before: WorldState, after: WorldState) -> Iterator[FactPattern]:
    """Yield the facts in which two versions of the world differ; also all facts of a transitive relation."""
    for relation, links in after.facts.items():
        if links is not before.facts[relation]:
            if relation in after.axioms.transitive:
                yield FactPattern(relation)
            for subject, object_ in set(links.pairs()) ^ set(before.facts[relation].pairs()):
                yield FactPattern(relation, subject, object_)
    for property_, table in after.stored.items():
        if table is not before.stored[property_]:
            changed = set(table.items()) ^ set(before.stored[property_].items())
            yield from (FactPattern(property_, individual) for individual in {each for each, _ in changed})


def find_settled_facts(change: Change, state: WorldState) -> Iterator[FactPattern]:
    """Yield all facts that a change makes true or false."""
    match change:
        case AddRelation(subject, relation, object_) | RemoveRelation(subject, relation, object_):
            for each in {*state.axioms.implied[relation], *state.axioms.sources[relation]}:
                yield from _find_settled_by_relation(each.relation, *each.ends(subject, object_), state)
        case SetProperty(individual, property_, _) | ClearProperty(individual, property_):
            yield FactPattern(property_, individual)
        case _:
            yield EVERYTHING


def _find_settled_by_relation(relation: str, subject: str, object_: str, state: WorldState) -> Iterator[FactPattern]:
    term = state.vocabulary.relations[relation]
    if relation not in state.axioms.transitive:
        yield FactPattern(relation, subject, object_)
    if term.functional:
        yield FactPattern(relation, subject, None)
    if term.inverse_functional:
        yield FactPattern(relation, None, object_)
