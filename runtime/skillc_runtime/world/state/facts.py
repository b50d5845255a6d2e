"""Single facts of a world, true or false, as things to ask about."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, slots=True)
class RelationFact:
    """The relation holds between two individuals, or does not."""

    subject: str
    relation: str
    object: str
    holds: bool = True


@dataclass(frozen=True, slots=True)
class PropertyFact:
    """The property of the individual has the value that it has, or none."""

    individual: str
    property: str


@dataclass(frozen=True, slots=True)
class ClassFact:
    """The individual is of the class, or is not."""

    individual: str
    cls: str
    holds: bool = True


Fact: TypeAlias = RelationFact | PropertyFact | ClassFact
