"""Values, facts and changes for recordings and messages: IRIs with their short names, numbers with their units."""

from __future__ import annotations

from typing import TypeAlias

import msgspec

from skillc_rdf.vocabulary.types import local_name as local

MILLI = {"mm": 1e3}
"""How many of a display unit make one SI unit."""


class LabelledIri(msgspec.Struct, frozen=True, tag="iri"):
    """An individual, class, relation or property; `label` is its short name, such as `lab:Arm-1` or `contain`."""

    iri: str
    label: str

    def __str__(self) -> str:
        return self.label


class LabelledQuantity(msgspec.Struct, frozen=True, tag="quantity"):
    """A number with its SI unit, a temperature in degC; the unit is empty for a pure number.

    In a message `{depth:.1f mm}` shows it with one digit in mm, `{depth}` with its unit.
    """

    value: float
    unit: str = ""

    def __post_init__(self) -> None:
        msgspec.structs.force_setattr(self, "value", float(self.value))

    def __format__(self, spec: str) -> str:
        digits, _, unit = spec.partition(" ")
        return f"{self.value * MILLI.get(unit, 1.0):{digits or 'g'}} {unit or self.unit}".strip()


class NotFinite(msgspec.Struct, frozen=True, tag="not-finite"):
    """A number that JSON cannot represent, as text: `inf N`."""

    text: str


class LabelledVector(msgspec.Struct, frozen=True, tag="vector"):
    """Three numbers with one unit, in the world frame."""

    components: tuple[float, float, float]
    unit: str = ""

    def __format__(self, spec: str) -> str:
        return f"({', '.join(format(part + 0.0, spec or 'g') for part in self.components)}) {self.unit}".strip()


class LabelledPose(msgspec.Struct, frozen=True, tag="pose"):
    """A position in m and an orientation as unit quaternion (w, x, y, z), in a frame."""

    position_m: tuple[float, float, float]
    quaternion_wxyz: tuple[float, float, float, float]
    frame: str = "world"


class ValueList(msgspec.Struct, frozen=True, tag="list"):
    """Several values."""

    values: tuple[LabelledValue, ...]


LabelledValue: TypeAlias = (
    bool | int | str | LabelledIri | LabelledQuantity | NotFinite | LabelledVector | LabelledPose | ValueList
)
"""Truth values, integers and texts are themselves."""


class LabelledRelation(msgspec.Struct, frozen=True, tag="relation", omit_defaults=True):
    """A relation holds between two individuals, or does not; None stands for any individual."""

    subject: LabelledIri | None
    relation: LabelledIri
    object: LabelledIri | None
    holds: bool = True


class LabelledProperty(msgspec.Struct, frozen=True, tag="property"):
    """A property of an individual with its value; None for no value."""

    individual: LabelledIri
    property: LabelledIri
    value: LabelledValue | None


class LabelledClass(msgspec.Struct, frozen=True, tag="class", omit_defaults=True):
    """An individual is of a class, or is not."""

    individual: LabelledIri
    cls: LabelledIri
    holds: bool = True


class LabelledIdentity(msgspec.Struct, frozen=True, tag="same", omit_defaults=True):
    """Two names denote the same individual, or do not."""

    one: LabelledIri
    other: LabelledIri
    holds: bool = True


class IndividualAdded(msgspec.Struct, frozen=True, tag="added"):
    """An individual was added."""

    individual: LabelledIri
    classes: tuple[LabelledIri, ...]


class IndividualRemoved(msgspec.Struct, frozen=True, tag="removed"):
    """An individual and all facts about it were removed."""

    individual: LabelledIri


LabelledFact: TypeAlias = LabelledRelation | LabelledProperty | LabelledClass | LabelledIdentity
LabelledChange: TypeAlias = LabelledRelation | LabelledProperty | IndividualAdded | IndividualRemoved
"""A change of a relation or a property is the fact that holds afterwards."""


def display_name(iri: str) -> str:
    """Return the name of an individual as words, for titles: `Box A` for `lab:Box-A`."""
    return local(iri).replace("-", " ").replace("_", " ")
