"""Reads recorded changes and values back."""

from __future__ import annotations

from typing import assert_never

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state.labels.labelled import (
    IndividualAdded,
    IndividualRemoved,
    LabelledChange,
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
from skillc_runtime.world.state.values import Value


def change_of(labelled: LabelledChange) -> Change:
    """Return the change of the world model that `label_change` describes, without rounding."""
    match labelled:
        case IndividualAdded(individual, classes):
            return AddIndividual(individual.iri, tuple(cls.iri for cls in classes))
        case IndividualRemoved(individual):
            return RemoveIndividual(individual.iri)
        case LabelledRelation(subject, relation, object_, holds):
            if subject is None or object_ is None:
                raise ValueError("a change of a relation names both individuals")
            change = AddRelation if holds else RemoveRelation
            return change(subject.iri, relation.iri, object_.iri)
        case LabelledProperty(individual, property_, None):
            return ClearProperty(individual.iri, property_.iri)
        case LabelledProperty(individual, property_, value):
            assert value is not None, "the case above"
            return SetProperty(individual.iri, property_.iri, value_of_labelled(value))
        case _:
            assert_never(labelled)


def value_of_labelled(labelled: LabelledValue) -> Value:
    """Return the value that `label_value` describes."""
    match labelled:
        case bool() | int() | str():
            return labelled
        case LabelledIri(iri):
            return iri
        case LabelledQuantity(value):
            return value
        case NotFinite(text):
            return float(text.split()[0])
        case LabelledVector(components):
            return np.array(components)
        case LabelledPose(position, quaternion):
            return Pose.of(position, quaternion)
        case ValueList(values):
            return tuple(value_of_labelled(each) for each in values)
        case _:
            assert_never(labelled)
