"""Finds the vocabulary terms and skills that a skill, an implementation or a task uses."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from skillc_model.conditions import (
    Adjust,
    Assert,
    Assign,
    Exists,
    Forall,
    HasProperty,
    Holds,
    Invoke,
    IsA,
    PropertyOf,
    Retract,
)
from skillc_model.traversal import find_calls, walk
from skillc_rdf.vocabulary.types import ClassType


def find_terms(item: msgspec.Struct) -> frozenset[str]:
    """Return the IRIs of the classes, relations and properties, and the names of the functions, inside `item`."""
    return frozenset(name for each in walk(item) for name in _named(each))


def find_called_skills(item: msgspec.Struct) -> tuple[str, ...]:
    """Return the skills called inside `item`, in the order of their first call."""
    return tuple(dict.fromkeys(each.skill for each in find_calls(item)))


def _named(item: msgspec.Struct) -> Iterator[str]:
    match item:
        case ClassType(iri=iri) | IsA(cls=iri) | Exists(cls=iri) | Forall(cls=iri):
            yield iri
        case Holds(relation=iri) | Assert(relation=iri) | Retract(relation=iri):
            yield iri
        case HasProperty(property=iri) | PropertyOf(property=iri) | Assign(property=iri) | Adjust(property=iri):
            yield iri
        case Invoke(function=name):
            yield name
        case _:
            pass
