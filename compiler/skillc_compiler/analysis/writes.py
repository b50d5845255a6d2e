"""What may be written: a relation, a value, an output, the end of a `once`."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeAlias, assert_never

from skillc_compiler.analysis.sorts import Sorts
from skillc_compiler.analysis.state import State
from skillc_model.conditions import (
    Assert,
    Assign,
    Compare,
    Condition,
    Effect,
    Holds,
    Individual,
    Literal,
    PropertyOf,
    Retract,
    Term,
    Variable,
)
from skillc_model.rewriting import substitute


@dataclass(frozen=True, slots=True)
class Related:
    """A relation that may be written: made true, made false, or either (None)."""

    subject: Term
    relation: str
    object: Term
    value: bool | None


@dataclass(frozen=True, slots=True)
class Valued:
    """A property that may be written; `value` is the constant or name it gets, None where that is not known.

    `cleared` tells that it may have no value afterwards.
    """

    subject: Term
    property: str
    value: Literal | Variable | Individual | None
    cleared: bool = False


@dataclass(frozen=True, slots=True)
class Assigned:
    """An output that may get a value."""

    name: str


@dataclass(frozen=True, slots=True)
class Ended:
    """A `once` that may have run."""

    key: int


Write: TypeAlias = Related | Valued | Assigned | Ended


def write_of(effect: Effect) -> Write:
    """Return what an effect writes."""
    match effect:
        case Assert(subject=subject, relation=relation, object=object_):
            return Related(subject, relation, object_, True)
        case Retract(subject=subject, relation=relation, object=object_):
            return Related(subject, relation, object_, False)
        case Assign(subject=subject, property=iri, value=value):
            return Valued(subject, iri, value if isinstance(value, Literal | Variable | Individual) else None)
        case _:
            assert_never(effect)


def either_way(write: Write) -> Write:
    """Return the write of which the result is not known."""
    match write:
        case Related():
            return replace(write, value=None)
        case Valued():
            return replace(write, value=None, cleared=True)
        case _:
            return write


def condition_of(write: Related | Valued) -> Condition | None:
    """Return the condition that holds once it is written; None where that leaves something open."""
    match write:
        case Related(value=None) | Valued(value=None):
            return None
        case Related(subject=subject, relation=relation, object=object_):
            return Holds(subject, relation, object_)
        case Valued(subject=Variable() | Individual() as subject, property=iri, value=value) if value is not None:
            return Compare(PropertyOf(subject, iri), "==", value)
    return None


def canonical(sorts: Sorts, state: State, write: Related) -> tuple[Term, str, Term]:
    """Return a written relation between the names that the state uses, in the direction that facts are kept in."""
    relation, turned = sorts.axioms.name.get(write.relation, (write.relation, False))
    subject, object_ = (substitute(term, state.same) for term in (write.subject, write.object))
    return (object_, relation, subject) if turned else (subject, relation, object_)
