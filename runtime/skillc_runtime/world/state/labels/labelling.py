"""Makes labelled values, facts and changes of those of the world model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import assert_never, cast

from skillc_model.format_type import SI_UNITS, in_written_unit
from skillc_model.skills import Parameter
from skillc_rdf.vocabulary.types import ClassType, ListType, NumberType, ValueType, VectorType, Vocabulary
from skillc_rdf.vocabulary.types import local_name as local
from skillc_runtime.motion import pose as motion
from skillc_runtime.motion.arrays import np
from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state.facts import ClassFact, Fact, PropertyFact, RelationFact
from skillc_runtime.world.state.labels.labelled import (
    IndividualAdded,
    IndividualRemoved,
    LabelledChange,
    LabelledClass,
    LabelledFact,
    LabelledIri,
    LabelledPose,
    LabelledProperty,
    LabelledQuantity,
    LabelledRelation,
    LabelledValue,
    LabelledVector,
    NotFinite,
    ValueList,
)
from skillc_runtime.world.state.properties import value_at
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


def label(iri: str, vocabulary: Vocabulary) -> LabelledIri:
    """Return an individual or a class with its short name."""
    return LabelledIri(iri, vocabulary.short(iri))


def label_term(iri: str) -> LabelledIri:
    """Return a relation or a property with its local name, as in conditions."""
    return LabelledIri(iri, local(iri))


def label_value(value: Value, type_: ValueType | None, vocabulary: Vocabulary) -> LabelledValue:
    """Return a value with units and short names; numbers are in SI units. `type_` is None if it is not known."""
    match value:
        case bool():
            return value
        case int() | float():
            return _number(value, type_)
        case str():
            return label(value, vocabulary) if isinstance(type_, ClassType) else value
        case motion.Pose():
            return label_pose(value)
        case np.ndarray():
            return _vector(value, type_)
        case tuple() | list():
            element = type_.element if isinstance(type_, ListType) else type_
            return ValueList(tuple(label_value(each, element, vocabulary) for each in value))
        case _:
            return str(value)


def label_bindings(
    bindings: Mapping[str, Value], parameters: Sequence[Parameter], vocabulary: Vocabulary
) -> dict[str, LabelledValue]:
    """Return the value of each bound parameter, in the order of the parameters."""
    bound = [parameter for parameter in parameters if parameter.name in bindings]
    return {each.name: label_value(bindings[each.name], each.type, vocabulary) for each in bound}


def label_pose(value: motion.Pose) -> LabelledPose:
    """Return a pose in the world with a quaternion for its orientation."""
    x, y, z = value.position.tolist()
    quaternion_w, *quaternion = motion.quaternion_from_rotation(value.rotation).tolist()
    return LabelledPose((x, y, z), (quaternion_w, *quaternion))


def make_recordable(value: object) -> LabelledValue:
    """Return a value from skill code as a value that can be recorded and read back."""
    match value:
        case LabelledQuantity(number) if not isfinite(number):
            return NotFinite(f"{value}")
        case LabelledIri() | LabelledQuantity() | NotFinite() | LabelledVector() | LabelledPose() | ValueList():
            return value
        case _:
            return label_value(cast(Value, value), None, Vocabulary())


def label_fact(fact: Fact, state: WorldState) -> LabelledFact:
    """Return a fact with the value that it has in a state."""
    vocabulary = state.vocabulary
    match fact:
        case RelationFact(subject, relation, object_, holds):
            return label_relation(subject, relation, object_, holds, vocabulary)
        case PropertyFact(individual, property_):
            return label_property(individual, property_, value_at(state, individual, property_), vocabulary)
        case ClassFact(individual, cls, holds):
            return LabelledClass(label(individual, vocabulary), label(cls, vocabulary), holds)
        case _:
            assert_never(fact)


def label_relation(
    subject: str | None, relation: str, object_: str | None, holds: bool, vocabulary: Vocabulary
) -> LabelledRelation:
    """Return that a relation holds or not, given by IRIs; None stands for any individual."""
    ends = (None if end is None else label(end, vocabulary) for end in (subject, object_))
    return LabelledRelation(next(ends), label_term(relation), next(ends), holds)


def label_property(individual: str, property_: str, value: Value | None, vocabulary: Vocabulary) -> LabelledProperty:
    """Return the value of a property, given by IRIs; None and an empty tuple mean no value."""
    term = vocabulary.properties.get(property_)
    empty = value is None or (isinstance(value, tuple) and not value)
    labelled = None if value is None or empty else label_value(value, term.type if term else None, vocabulary)
    return LabelledProperty(label(individual, vocabulary), label_term(property_), labelled)


def label_change(change: Change, vocabulary: Vocabulary) -> LabelledChange:
    """Return a change of the world model."""
    match change:
        case AddIndividual(individual, types):
            return IndividualAdded(label(individual, vocabulary), tuple(label(cls, vocabulary) for cls in types))
        case RemoveIndividual(individual):
            return IndividualRemoved(label(individual, vocabulary))
        case AddRelation(subject, relation, object_) | RemoveRelation(subject, relation, object_):
            return label_relation(subject, relation, object_, isinstance(change, AddRelation), vocabulary)
        case SetProperty(individual, property_, value):
            return label_property(individual, property_, value, vocabulary)
        case ClearProperty(individual, property_):
            return label_property(individual, property_, None, vocabulary)
        case _:
            assert_never(change)


def _number(value: float, type_: ValueType | None) -> LabelledValue:
    """Return a number with its unit."""
    if isinstance(value, int) and not isinstance(type_, NumberType):
        return value
    value, unit = in_written_unit(value, type_.dimension) if isinstance(type_, NumberType) else (value, "")
    return LabelledQuantity(float(value), unit) if isfinite(value) else NotFinite(f"{value:g} {unit}".strip())


def _vector(value: np.ndarray, type_: ValueType | None) -> LabelledValue:
    """Return a vector (3,) with its unit; an array of another size as a list."""
    unit = SI_UNITS.get(type_.dimension, "") if isinstance(type_, VectorType) else ""
    match value.ravel().tolist():
        case [x, y, z]:
            return LabelledVector((x, y, z), unit)
        case parts:
            return ValueList(tuple(LabelledQuantity(part, unit) for part in parts))
