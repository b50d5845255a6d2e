"""What conditions read: the relations and properties in them, and whether they call Python, which may read anything."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

from skillc_model.conditions import (
    Aggregate,
    Condition,
    Exists,
    Forall,
    HasProperty,
    Holds,
    Individual,
    Invoke,
    IsA,
    PropertyOf,
    Same,
    Variable,
)
from skillc_model.traversal import walk


class Readers(NamedTuple):
    """Conditions by the relations and by the properties that they read, and those that call Python."""

    of_relations: Mapping[str, Sequence[Condition]]
    of_values: Mapping[str, Sequence[Condition]]
    by_python: Sequence[Condition]


def find_readers(conditions: Iterable[Condition]) -> Readers:
    """Return conditions by what they read."""
    relations, values = defaultdict[str, list[Condition]](list), defaultdict[str, list[Condition]](list)
    python = []
    for condition in conditions:
        for relation in relations_read(condition):
            relations[relation].append(condition)
        if isinstance(condition, Holds):
            continue
        for iri in dict.fromkeys(iri for _, iri in values_read(condition)):
            values[iri].append(condition)
        if calls_python(condition):
            python.append(condition)
    return Readers(dict(relations), dict(values), python)


@lru_cache(maxsize=16384)
def values_read(condition: Condition) -> tuple[tuple[Variable | Individual | None, str], ...]:
    """Return the properties that a condition reads, each with the individual, None if that is any."""
    bound = {each.variable for each in walk(condition) if isinstance(each, Exists | Forall | Aggregate)}
    found: list[tuple[Variable | Individual | None, str]] = []
    for each in walk(condition):
        match each:
            case HasProperty(subject=of, property=iri) | PropertyOf(of=of, property=iri):
                plain = isinstance(of, Individual) or (isinstance(of, Variable) and of.name not in bound)
                found.append((of if plain and isinstance(of, Variable | Individual) else None, iri))
    return tuple(found)


@lru_cache(maxsize=16384)
def relations_read(condition: Condition) -> frozenset[str]:
    """Return the relations that a condition reads."""
    return frozenset(each.relation for each in walk(condition) if isinstance(each, Holds))


@lru_cache(maxsize=16384)
def calls_python(condition: Condition) -> bool:
    """Whether a condition calls Python, which may read anything."""
    return not isinstance(condition, Same | IsA) and any(isinstance(each, Invoke) for each in walk(condition))
