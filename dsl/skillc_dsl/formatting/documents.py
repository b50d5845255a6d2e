"""Documents: text with the places where its lines may or must break."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, slots=True)
class Text:
    """Characters that stay together."""

    text: str


@dataclass(frozen=True, slots=True)
class Space:
    """A space between two texts of one line."""


@dataclass(frozen=True, slots=True)
class Line:
    """A place where a group breaks that does not fit its line; otherwise `flat`."""

    flat: str = " "


@dataclass(frozen=True, slots=True)
class NewLine:
    """A place where the line ends."""


@dataclass(frozen=True, slots=True)
class Blank:
    """A wish for one blank line before what follows."""


@dataclass(frozen=True, slots=True)
class Remark:
    """A comment at the end of its line."""

    text: str


@dataclass(frozen=True, slots=True)
class Note:
    """A comment on a line of its own."""

    text: str


@dataclass(frozen=True, slots=True)
class Mark:
    """A comma or an opening brace: it stays on the line of what it follows, before any comment there."""

    text: str


@dataclass(frozen=True, slots=True)
class WhenBroken:
    """A mark only in a group that breaks."""

    text: str


@dataclass(frozen=True, slots=True)
class Nest:
    """What is indented by one step, from its next line on."""

    body: Document


@dataclass(frozen=True, slots=True)
class Group:
    """What stands on one line if it fits; otherwise every `Line` of it breaks, those of inner groups aside."""

    body: Document


@dataclass(frozen=True, slots=True)
class Joined:
    """Parts one after the other."""

    parts: tuple[Document, ...]


Leaf: TypeAlias = Text | Space | Line | NewLine | Blank | Remark | Note | Mark | WhenBroken
Document: TypeAlias = Leaf | Nest | Group | Joined
NOTHING = Joined(())


def joined(*parts: Document) -> Joined:
    """Put parts one after the other."""
    return Joined(parts)


def leaves(document: Document) -> Iterator[Leaf]:
    """Yield what a document is made of, in order."""
    match document:
        case Nest(body=body) | Group(body=body):
            yield from leaves(body)
        case Joined(parts=parts):
            for part in parts:
                yield from leaves(part)
        case _:
            yield document


def has_comment(document: Document) -> bool:
    """Whether a comment among the texts of a document makes its lines break; one after all of them does not."""
    remarked = False
    for leaf in leaves(document):
        if isinstance(leaf, Note) or (remarked and isinstance(leaf, Text)):
            return True
        remarked = remarked or isinstance(leaf, Remark)
    return False
