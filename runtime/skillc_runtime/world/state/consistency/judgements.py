"""Facts that are judged from numbers: whether what was measured of a thing reaches the threshold that it has."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.world.state.changes import Change, ClearProperty, SetProperty
from skillc_runtime.world.state.world_state import WorldState


def add_judgements(state: WorldState, changes: tuple[Change, ...]) -> tuple[Change, ...]:
    """Return changes of a world with what is judged from the numbers and thresholds that they set.

    What they state themselves is not judged.
    """
    judged = state.vocabulary.judged_from
    numbers = [each for each in changes if isinstance(each, SetProperty) and each.property in judged]
    return (*changes, *_judge(state.with_changes(changes), changes, numbers)) if numbers else changes


def _judge(after: WorldState, changes: tuple[Change, ...], numbers: list[SetProperty]) -> Iterator[Change]:
    stated = {(each.individual, each.property) for each in changes if isinstance(each, SetProperty | ClearProperty)}
    judged = after.vocabulary.judged_from
    for individual, iri in sorted({(each.individual, term) for each in numbers for term in judged[each.property]}):
        term = after.vocabulary.properties[iri]
        if (individual, iri) in stated or term.measure is None or term.threshold is None:
            continue
        measured, least = after.value(individual, term.measure), after.value(individual, term.threshold)
        if isinstance(measured, int | float) and isinstance(least, int | float):
            yield SetProperty(individual, iri, measured >= least)
