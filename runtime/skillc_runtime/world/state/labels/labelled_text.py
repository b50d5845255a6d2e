"""Formats labelled values and facts in the syntax of the language."""

from __future__ import annotations

from typing import assert_never

from skillc_model.format_condition import format_class, format_property, format_relation
from skillc_runtime.world.state.labels.labelled import (
    LabelledClass,
    LabelledFact,
    LabelledIdentity,
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

LISTED = 3
"""Of longer lists only the length is shown."""

ANY = "_"


def format_value(value: LabelledValue) -> str:
    """Return a value as an author would write it; a long list as its length."""
    match value:
        case bool():
            return "true" if value else "false"
        case int():
            return str(value)
        case str():
            return f'"{value}"'
        case LabelledIri(_, name):
            return name
        case LabelledQuantity() | LabelledVector():
            return f"{value}"
        case NotFinite(text):
            return text
        case LabelledPose(position_m):
            return f"pose at {LabelledVector(position_m)}"
        case ValueList(values) if len(values) > LISTED:
            return f"{len(values)} values"
        case ValueList(values):
            return f"[{', '.join(map(format_value, values))}]"
        case _:
            assert_never(value)


def format_fact(fact: LabelledFact) -> str:
    """Return a fact in the syntax of the language, such as `not lab:Gripper-1 contain lab:Eraser-1`."""
    match fact:
        case LabelledRelation(subject, relation, object_, holds):
            ends = [ANY if end is None else end.label for end in (subject, object_)]
            return format_relation(ends[0], relation.iri, ends[1], holds)
        case LabelledProperty(individual, property_, value):
            return format_property(individual.label, property_.iri, None if value is None else format_value(value))
        case LabelledClass(individual, cls, holds):
            return format_class(individual.label, cls.label, holds)
        case LabelledIdentity(one, other, holds):
            return f"{one.label} {'==' if holds else '!='} {other.label}"
        case _:
            assert_never(fact)
