"""The types of expressions in the compiler, and which type fits where."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_dsl.units import DIMENSIONS, NUMBER, Dimension
from skillc_rdf.vocabulary.types import (
    THING,
    ClassType,
    DirectionType,
    ListType,
    NumberType,
    PlainType,
    ValueType,
    VectorType,
    Vocabulary,
    local_name,
)


class UnknownType(msgspec.Struct, frozen=True):
    """The type of an unresolved expression; it fits everywhere, so that one mistake gives one error."""


class Thing(msgspec.Struct, frozen=True):
    """An individual; `cls` is the IRI of its class, None if only the scene determines it."""

    cls: str | None


class Measure(msgspec.Struct, frozen=True):
    """A number of a dimension, in SI units."""

    dimension: Dimension


class Vector(msgspec.Struct, frozen=True):
    """Three numbers of a dimension, in the world frame."""

    dimension: Dimension


class Direction(msgspec.Struct, frozen=True):
    """A dimensionless vector of length 1."""


class Plain(msgspec.Struct, frozen=True):
    """`Bool`, `Int`, `Text`, `Message` or `Pose`."""

    name: Literal["Bool", "Int", "Text", "Message", "Pose"]


class ListOf(msgspec.Struct, frozen=True):
    """A list, `[T]`."""

    element: Type


Type: TypeAlias = UnknownType | Thing | Measure | Vector | Direction | Plain | ListOf
UNKNOWN = UnknownType()
BOOL, INT, TEXT, MESSAGE = Plain("Bool"), Plain("Int"), Plain("Text"), Plain("Message")


def type_of(declared: ValueType) -> Type:
    """Return the type for a declared type; an undeclared dimension gives UNKNOWN."""
    match declared:
        case ClassType(iri=iri):
            return Thing(iri)
        case NumberType(dimension=name):
            return Measure(DIMENSIONS[name]) if name in DIMENSIONS else UNKNOWN
        case VectorType(dimension=name):
            return Vector(DIMENSIONS[name]) if name in DIMENSIONS else UNKNOWN
        case DirectionType():
            return Direction()
        case PlainType(name=name):
            return Plain(name)
        case ListType(element=element):
            return ListOf(type_of(element))


def declared_as(kind: Type) -> ValueType | None:
    """Return the declared type of a type; None for UNKNOWN, and for a dimension without a name."""
    match kind:
        case Thing(cls=cls):
            return ClassType(cls or THING)
        case Measure(dimension=dimension) | Vector(dimension=dimension):
            of = NumberType if isinstance(kind, Measure) else VectorType
            return next((of(name) for name, each in DIMENSIONS.items() if each.join(dimension)), None)
        case Direction():
            return DirectionType()
        case Plain(name=name):
            return PlainType(name)
        case ListOf(element=element):
            inner = declared_as(element)
            return inner and ListType(inner)
        case _:
            return None


def fits(vocabulary: Vocabulary, given: Type, wanted: Type) -> bool:
    """Whether a value of type `given` may stand where one of type `wanted` is expected."""
    match given, wanted:
        case (UnknownType(), _) | (_, UnknownType()):
            return True
        case Thing(cls=one), Thing(cls=other):
            return one is None or other is None or vocabulary.is_a(one, other)
        case Direction(), Vector(dimension=dimension):
            return dimension == NUMBER
        case Plain(name="Text" | "Message"), Plain(name="Text" | "Message"):
            return True
        case Plain(name="Int"), Measure(dimension=dimension):
            return dimension == NUMBER
        case (Measure(dimension=one), Measure(dimension=other)) | (Vector(dimension=one), Vector(dimension=other)):
            return one.join(other) is not None
        case ListOf(element=one), ListOf(element=other):
            return fits(vocabulary, one, other)
    return given == wanted


def describe_type(kind: Type) -> str:
    """Return the type as it is shown to authors, with its article: `a Force`, `an ArmDevice`."""
    match kind:
        case UnknownType():
            return "something unknown"
        case Thing(cls=iri):
            return _with_article(local_name(iri)) if iri else "an individual"
        case Vector(dimension=dimension):
            return "a Vector of pure numbers" if dimension == NUMBER else f"a Vector of {dimension_name(dimension)}"
        case Direction():
            return "a Direction"
        case ListOf(element=element):
            return f"a list, each {describe_type(element)}"
        case Measure(dimension=dimension):
            return _with_article(dimension_name(dimension))
        case Plain(name=text):
            return _with_article(text)


def dimension_name(dimension: Dimension) -> str:
    """Return the name of a dimension, also for dimensions without a name in the language."""
    return "Number" if dimension == NUMBER else dimension.name


def _with_article(word: str) -> str:
    return f"an {word}" if word[:1] in "AEIOUaeiou" else f"a {word}"
