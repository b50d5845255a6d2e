"""What is true in a simulated world, but not known: skills that look there find it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias, assert_never

import msgspec

from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
    named_individuals,
)

_Slot: TypeAlias = tuple[str, ...]


class HiddenTruth(msgspec.Struct, frozen=True):
    """What has to change in what is known for all to be known; it says everything about the terms `about`."""

    facts: tuple[Change, ...] = ()
    about: frozenset[str] = frozenset()

    def without_known(self, changes: Sequence[Change], vocabulary: Vocabulary) -> HiddenTruth:
        """Return what is still hidden after changes: nothing that is written holds on to what was true before."""
        written = {slot for change in changes for slot in _slots(change, vocabulary)}
        removed = {change.individual for change in changes if isinstance(change, RemoveIndividual)}
        kept = tuple(
            each
            for each in self.facts
            if written.isdisjoint(_slots(each, vocabulary)) and removed.isdisjoint(named_individuals(each))
        )
        return self if len(kept) == len(self.facts) else msgspec.structs.replace(self, facts=kept)


NOTHING_HIDDEN = HiddenTruth()


def hide(facts: Iterable[Change], vocabulary: Vocabulary) -> HiddenTruth:
    """Return what is true besides what is known."""
    hidden = tuple(facts)
    return HiddenTruth(hidden, frozenset(slot[0] for each in hidden for slot in _slots(each, vocabulary)))


def _slots(change: Change, vocabulary: Vocabulary) -> Iterator[_Slot]:
    """Yield what a change decides: a property of a thing, whether a relation holds, the one thing that it leads to."""
    match change:
        case AddRelation(subject, relation, object_):
            yield relation, subject, object_
            if vocabulary.relations[relation].functional:
                yield relation, subject, ""
            if vocabulary.relations[relation].inverse_functional:
                yield relation, "", object_
        case RemoveRelation(subject, relation, object_):
            yield relation, subject, object_
        case SetProperty(individual, property_, _) | ClearProperty(individual, property_):
            yield property_, individual
        case AddIndividual() | RemoveIndividual():
            pass
        case _:
            assert_never(change)
