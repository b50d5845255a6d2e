"""What may be written: a relation, a value, an output, the result of a `once`."""

from __future__ import annotations

from typing import TypeAlias, assert_never

import msgspec

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes, any_individual
from skillc_compiler.analysis.knowledge.state import IndividualTerm, State
from skillc_model.conditions import (
    Adjust,
    Assert,
    Assign,
    Compare,
    Condition,
    Effect,
    ForEach,
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
    """A relation that may be written: made true, made false, or either (None).

    `when` is what any individual in it fulfilled before if it is written, None if that is not known; `apart` are
    individuals that are certainly none of these.
    """

    subject: Term
    relation: str
    object: Term
    value: bool | None
    when: Condition | None = None
    apart: frozenset[IndividualTerm] = frozenset()


class PropertyWrite(msgspec.Struct, frozen=True):
    """A property that may be written; `value` is the constant or name that it gets, None if not known.

    `cleared` if it may have no value afterwards; `when` and `apart` as for relations; `is_change` if it is what the
    number before makes of it.
    """

    subject: Term
    property: str
    value: Literal | Variable | Individual | None
    cleared: bool = False
    when: Condition | None = None
    apart: frozenset[IndividualTerm] = frozenset()
    is_change: bool = False


class OutputWrite(msgspec.Struct, frozen=True):
    """An output that may be assigned."""

    name: str


class OnceWrite(msgspec.Struct, frozen=True):
    """A `once` node that may have run."""

    key: int


Write: TypeAlias = RelationWrite | PropertyWrite | OutputWrite | OnceWrite
EACH = "|each"
"""The variable of an effect on each individual, in its one form; no name in a file begins like this."""
NO_WRITES: frozenset[Write] = frozenset()


def write_of(effect: Effect) -> Write:
    """Return the write of an effect; one on all individuals that fulfil a condition may be on any."""
    match effect:
        case ForEach(variable=variable, cls=cls, effect=single):
            named = {variable: any_individual(cls)}
            write = write_of(substitute(single, named))
            assert isinstance(write, RelationWrite | PropertyWrite), "an effect writes a relation or a property"
            return msgspec.structs.replace(write, value=None, when=substitute(effect.when, named))
        case Assert(subject=subject, relation=relation, object=object_):
            return RelationWrite(subject, relation, object_, True)
        case Retract(subject=subject, relation=relation, object=object_):
            return RelationWrite(subject, relation, object_, False)
        case Assign(subject=subject, property=iri, value=value):
            return PropertyWrite(subject, iri, value if isinstance(value, Literal | Variable | Individual) else None)
        case Adjust(subject=subject, property=iri):
            return PropertyWrite(subject, iri, None, is_change=True)
        case _:
            assert_never(effect)


def normalise_each(effect: ForEach) -> ForEach:
    """Return the one form of all effects that differ only in the name of their variable."""
    named = {effect.variable: Variable(EACH)}
    return ForEach(EACH, effect.cls, substitute(effect.when, named), substitute(effect.effect, named))


def may_undo(types: AliasTypes, write: Write, each: ForEach) -> bool:
    """Whether a write may undo something of an effect on all individuals of a class."""
    match each.effect, write:
        case Assign(property=iri) | Adjust(property=iri), PropertyWrite(property=written):
            return iri == written
        case Assert(relation=iri) | Retract(relation=iri), RelationWrite(relation=written):
            canonical = types.axioms.canonical
            one, other = (canonical.get(relation, (relation, False))[0] for relation in (iri, written))
            return one in types.axioms.affected.get(other, frozenset({other}))
    return False


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
