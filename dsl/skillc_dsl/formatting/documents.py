"""Documents for layout: text with the places where lines may or must break."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, slots=True)
class Fragment:
    """Characters that stay together."""

    text: str


@dataclass(frozen=True, slots=True)
class Gap:
    """A space between two texts of one line."""


@dataclass(frozen=True, slots=True)
class SoftBreak:
    """A place where a group breaks that does not fit its line; otherwise `flat`."""

    flat: str = " "


@dataclass(frozen=True, slots=True)
class HardBreak:
    """A place where the line ends."""


@dataclass(frozen=True, slots=True)
class BlankLine:
    """A wish for one blank line before what follows."""


@dataclass(frozen=True, slots=True)
class TrailingComment:
    """A comment at the end of its line."""

    text: str


@dataclass(frozen=True, slots=True)
class CommentLine:
    """A comment on a line of its own."""

    text: str


@dataclass(frozen=True, slots=True)
class Punctuation:
    """A comma or an opening brace: it stays on the line of what it follows, before any comment there."""

    text: str


@dataclass(frozen=True, slots=True)
class WhenBroken:
    """A mark only in a group that breaks."""

    text: str


@dataclass(frozen=True, slots=True)
class Indent:
    """What is indented by one step, from its next line on."""

    body: Document


@dataclass(frozen=True, slots=True)
class DocumentGroup:
    """What stands on one line if it fits; otherwise every `SoftBreak` of it breaks, those of inner groups aside."""

    body: Document


@dataclass(frozen=True, slots=True)
class Concatenation:
    """Parts one after the other."""

    parts: tuple[Document, ...]


Leaf: TypeAlias = (
    Fragment | Gap | SoftBreak | HardBreak | BlankLine | TrailingComment | CommentLine | Punctuation | WhenBroken
)
Document: TypeAlias = Leaf | Indent | DocumentGroup | Concatenation
NOTHING = Concatenation(())


def concatenate(*parts: Document) -> Concatenation:
    """Put parts one after the other."""
    return Concatenation(parts)


def leaves(document: Document) -> Iterator[Leaf]:
    """Yield what a document is made of, in order."""
    match document:
        case Indent(body=body) | DocumentGroup(body=body):
            yield from leaves(body)
        case Concatenation(parts=parts):
            for part in parts:
                yield from leaves(part)
        case _:
            yield document


def has_comment(document: Document) -> bool:
    """Whether a comment among the texts of a document makes its lines break; one after all of them does not."""
    remarked = False
    for leaf in leaves(document):
        if isinstance(leaf, CommentLine) or (remarked and isinstance(leaf, Fragment)):
            return True
        remarked = remarked or isinstance(leaf, TrailingComment)
    return False
