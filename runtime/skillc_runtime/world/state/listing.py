"""All that a world state says of each individual, in a fixed order."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class ListingEntry:
    """An individual with its declared classes, the relations written of it and its stored properties, all by IRI."""

    individual: str
    types: tuple[str, ...]
    relations: tuple[tuple[str, str], ...]
    properties: tuple[tuple[str, Value], ...]


def list_entries(state: WorldState, individuals: Iterable[str]) -> tuple[ListingEntry, ...]:
    """Return an entry for each of the individuals, sorted by IRI."""
    return tuple(_entry(state, individual) for individual in sorted(individuals))


def _entry(state: WorldState, individual: str) -> ListingEntry:
    relations = [
        (relation, object_)
        for relation, links in sorted(state.asserted.items())
        for object_ in sorted(links.forward.get(individual))
    ]
    values = [(iri, table.get(individual)) for iri, table in sorted(state.stored.items())]
    properties = tuple((iri, value) for iri, value in values if value is not None)
    return ListingEntry(individual, tuple(sorted(state.types(individual))), tuple(relations), properties)
