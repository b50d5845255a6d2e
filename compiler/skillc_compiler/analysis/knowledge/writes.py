"""What may be written: a relation, a value, an output, the result of a `once`."""

from __future__ import annotations

from typing import TypeAlias, assert_never

import msgspec

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.state import State
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


class RelationWrite(msgspec.Struct, frozen=True):
    """A relation that may be written: made true, made false, or either (None)."""

    subject: Term
    relation: str
    object: Term
    value: bool | None


class PropertyWrite(msgspec.Struct, frozen=True):
    """A property that may be written; `value` is the constant or name that it gets, None if not known.

    `cleared` if it may have no value afterwards.
    """

    subject: Term
    property: str
    value: Literal | Variable | Individual | None
    cleared: bool = False


class OutputWrite(msgspec.Struct, frozen=True):
    """An output that may be assigned."""

    name: str


class OnceWrite(msgspec.Struct, frozen=True):
    """A `once` node that may have run."""

    key: int


Write: TypeAlias = RelationWrite | PropertyWrite | OutputWrite | OnceWrite
NO_WRITES: frozenset[Write] = frozenset()


def write_of(effect: Effect) -> Write:
    """Return the write of an effect."""
    match effect:
        case Assert(subject=subject, relation=relation, object=object_):
            return RelationWrite(subject, relation, object_, True)
        case Retract(subject=subject, relation=relation, object=object_):
            return RelationWrite(subject, relation, object_, False)
        case Assign(subject=subject, property=iri, value=value):
            return PropertyWrite(subject, iri, value if isinstance(value, Literal | Variable | Individual) else None)
        case _:
            assert_never(effect)


def with_unknown_value(write: Write) -> Write:
    """Return the write with an unknown result."""
    match write:
        case RelationWrite():
            return msgspec.structs.replace(write, value=None)
        case PropertyWrite():
            return msgspec.structs.replace(write, value=None, cleared=True)
        case _:
            return write


def written_condition(write: RelationWrite | PropertyWrite) -> Condition | None:
    """Return the condition that holds once it is written, or None if that is not determined."""
    match write:
        case RelationWrite(value=None) | PropertyWrite(value=None):
            return None
        case RelationWrite(subject=subject, relation=relation, object=object_):
            return Holds(subject, relation, object_)
        case PropertyWrite(subject=Variable() | Individual() as subject, property=iri, value=value) if (
            value is not None
        ):
            return Compare(PropertyOf(subject, iri), "==", value)
    return None


def canonical_relation(types: AliasTypes, state: State, write: RelationWrite) -> tuple[Term, str, Term]:
    """Return a written relation as (subject, relation, object) in the names and direction that the state uses."""
    relation, turned = types.axioms.canonical.get(write.relation, (write.relation, False))
    subject, object_ = (substitute(term, state.aliases) for term in (write.subject, write.object))
    return (object_, relation, subject) if turned else (subject, relation, object_)
