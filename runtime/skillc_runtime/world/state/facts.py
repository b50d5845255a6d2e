"""References to single facts of a world, which may be true or false; labelled facts are in `labelled`."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec


class RelationFact(msgspec.Struct, frozen=True):
    """A relation that holds between two individuals, or does not."""

    subject: str
    relation: str
    object: str
    holds: bool = True


class PropertyFact(msgspec.Struct, frozen=True):
    """The value of a property of an individual, whatever it is."""

    individual: str
    property: str


class ClassFact(msgspec.Struct, frozen=True):
    """An individual that is of a class, or is not."""

    individual: str
    cls: str
    holds: bool = True


Fact: TypeAlias = RelationFact | PropertyFact | ClassFact

IriTriple: TypeAlias = tuple[str, str, str]
"""An asserted relation or class: subject, predicate and object, all IRIs."""


Evidence: TypeAlias = Literal["sensed", "reported", "idealised", "assumed"]
"""`sensed`: measured; `reported`: a device reports it about itself; `assumed`: neither.

`idealised`: measured or reported by a device, or in a cell, that idealises what was measured: a camera that reads the
simulator's map of a surface, contact in a cell without physics.
"""
