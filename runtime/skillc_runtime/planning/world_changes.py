"""The facts in which versions of the world differ, and those that a change settles."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_model.read_write import EVERYTHING, FactPattern
from skillc_runtime.world.state.changes import AddRelation, Change, ClearProperty, RemoveRelation, SetProperty
from skillc_runtime.world.state.world_state import WorldState


def changed_between(before: WorldState, after: WorldState) -> Iterator[FactPattern]:
    """Yield the facts in which two versions of the world differ; of a transitive relation, any."""
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


def settled_by(change: Change, state: WorldState) -> Iterator[FactPattern]:
    """Yield all facts that a change decides, those included that it takes away."""
    match change:
        case AddRelation(subject, relation, object_) | RemoveRelation(subject, relation, object_):
            for each in {*state.axioms.implied[relation], *state.axioms.sources[relation]}:
                yield from _settled(each.relation, *each.ends(subject, object_), state)
        case SetProperty(individual, property_, _) | ClearProperty(individual, property_):
            yield FactPattern(property_, individual)
        case _:
            yield EVERYTHING


def _settled(relation: str, subject: str, object_: str, state: WorldState) -> Iterator[FactPattern]:
    term = state.vocabulary.relations[relation]
    if relation not in state.axioms.transitive:
        yield FactPattern(relation, subject, object_)
    if term.functional:
        yield FactPattern(relation, subject, None)
    if term.inverse_functional:
        yield FactPattern(relation, None, object_)
