"""The types of values, and expressions and conditions as the runtime evaluates them.

Names are resolved to IRIs, quantities are in SI units.
"""

from __future__ import annotations

from typing import Literal as OneOf
from typing import TypeAlias

import msgspec


class ClassType(msgspec.Struct, frozen=True, tag="class"):
    """An individual of an ontology class, given by IRI."""

    iri: str


class NumberType(msgspec.Struct, frozen=True, tag="number"):
    """A number in SI units; `dimension` is a name of the language (`Force`), `Number` without one."""

    dimension: str


class VectorType(msgspec.Struct, frozen=True, tag="vector"):
    """Three numbers of one dimension in the world frame; `Number` if dimensionless."""

    dimension: str


class DirectionType(msgspec.Struct, frozen=True, tag="direction"):
    """A unit vector in the world frame."""


class PlainType(msgspec.Struct, frozen=True, tag="plain"):
    """`Bool`, `Int`, `Text`, `Message` or `Pose`; a message is a text, in which values are read where it is written."""

    name: OneOf["Bool", "Int", "Text", "Message", "Pose"]


class ListType(msgspec.Struct, frozen=True, tag="list"):
    """`[T]`"""

    element: ValueType


ValueType: TypeAlias = ClassType | NumberType | VectorType | DirectionType | PlainType | ListType


class Literal(msgspec.Struct, frozen=True, tag="literal"):
    """A constant; numbers in SI units, enumeration values as text."""

    value: bool | int | float | str


class Variable(msgspec.Struct, frozen=True, tag="variable"):
    """A parameter, let, loop variable, output or quantified variable in scope."""

    name: str


class Individual(msgspec.Struct, frozen=True, tag="individual"):
    """A named individual of the world."""

    iri: str


class PropertyOf(msgspec.Struct, frozen=True, tag="property"):
    """The value of a data property (stored or computed) of an individual, or the one thing of a functional relation."""

    of: Expression
    property: str


class Arithmetic(msgspec.Struct, frozen=True, tag="arithmetic"):
    """`left operator right` on numbers, or vectors where the types allow it."""

    operator: OneOf["+", "-", "*", "/"]
    left: Expression
    right: Expression


class Invoke(msgspec.Struct, frozen=True, tag="invoke"):
    """A vocabulary function applied to values."""

    function: str
    arguments: tuple[Expression, ...]


class ListValue(msgspec.Struct, frozen=True, tag="list"):
    """A list of these values."""

    items: tuple[Expression, ...]


class Aggregate(msgspec.Struct, frozen=True, tag="aggregate"):
    """A number, or a list, of the individuals of a class of which a condition holds.

    `count` is how many there are; `sum`, `min`, `max` and `mean` are of the value of each. Of no individual, the last
    three have no value. `ordered` is the list of them in the order of their values; equal ones in that of IRIs.
    """

    function: OneOf["count", "sum", "min", "max", "mean", "ordered"]
    variable: str
    cls: str
    where: Condition
    value: Expression


class NamedValue(msgspec.Struct, frozen=True):
    """A value in a text, by its name; `type` is None if it is not known."""

    name: str
    value: Expression
    type: ValueType | None


class Message(msgspec.Struct, frozen=True, tag="message"):
    """A text with values: `{name}` in it stands for one of them, and braces stand twice."""

    text: str
    values: tuple[NamedValue, ...]


Expression: TypeAlias = (
    Literal | Variable | Individual | PropertyOf | Arithmetic | Invoke | ListValue | Aggregate | Message
)


class Anything(msgspec.Struct, frozen=True, tag="anything"):
    """`_`: any individual."""


Term: TypeAlias = Variable | Individual | Anything


class Holds(msgspec.Struct, frozen=True, tag="holds"):
    """`subject relation object`"""

    subject: Term
    relation: str
    object: Term


Operator: TypeAlias = OneOf["==", "!=", "<", "<=", ">", ">="]


class Compare(msgspec.Struct, frozen=True, tag="compare"):
    """`left operator right` on data values; false when a property read on either side is missing."""

    left: Expression
    operator: Operator
    right: Expression


class Same(msgspec.Struct, frozen=True, tag="same"):
    """Both terms are the same individual."""

    left: Term
    right: Term


class HasProperty(msgspec.Struct, frozen=True, tag="has"):
    """The individual has a value for the property."""

    subject: Term
    property: str


class IsA(msgspec.Struct, frozen=True, tag="is"):
    """The individual is of the class or of a subclass."""

    subject: Term
    cls: str


class Given(msgspec.Struct, frozen=True, tag="given"):
    """The optional parameter was passed."""

    parameter: str


class Not(msgspec.Struct, frozen=True, tag="not"):
    """The body does not hold."""

    body: Condition


class And(msgspec.Struct, frozen=True, tag="and"):
    """All parts hold; true when empty."""

    parts: tuple[Condition, ...]


class Or(msgspec.Struct, frozen=True, tag="or"):
    """Some part holds; false when empty. `a implies b` is `not a or b`."""

    parts: tuple[Condition, ...]


class Exists(msgspec.Struct, frozen=True, tag="exists"):
    """The body holds for some individual of the class."""

    variable: str
    cls: str
    body: Condition


class Forall(msgspec.Struct, frozen=True, tag="forall"):
    """The body holds for every individual of the class."""

    variable: str
    cls: str
    body: Condition


Condition: TypeAlias = Holds | Compare | Same | HasProperty | IsA | Given | Not | And | Or | Exists | Forall
