"""Documents: text with the places where lines may or must break."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, slots=True)
class Fragment:
    """Text that is never broken."""

    text: str


@dataclass(frozen=True, slots=True)
class Gap:
    """A space between two texts of one line."""


@dataclass(frozen=True, slots=True)
class SoftBreak:
    """A line break if the enclosing group does not fit its line; otherwise the text `flat`."""

    flat: str = " "


@dataclass(frozen=True, slots=True)
class HardBreak:
    """A line break."""


@dataclass(frozen=True, slots=True)
class BlankLine:
    """One blank line before the next text, where a blank line is allowed."""


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
    """A comma or an opening brace: it stays on the line of the preceding text, before any comment."""

    text: str


@dataclass(frozen=True, slots=True)
class WhenBroken:
    """Text that is only written if the enclosing group breaks."""

    text: str


@dataclass(frozen=True, slots=True)
class Indent:
    """A document whose lines after the first are indented by one step."""

    body: Document


@dataclass(frozen=True, slots=True)
class DocumentGroup:
    """A document on one line if it fits; otherwise each `SoftBreak` that is not in an inner group breaks."""

    body: Document


@dataclass(frozen=True, slots=True)
class Concatenation:
    """A sequence of documents."""

    parts: tuple[Document, ...]


Leaf: TypeAlias = (
    Fragment | Gap | SoftBreak | HardBreak | BlankLine | TrailingComment | CommentLine | Punctuation | WhenBroken
)
Document: TypeAlias = Leaf | Indent | DocumentGroup | Concatenation
NOTHING = Concatenation(())


def concatenate(*parts: Document) -> Concatenation:
    """Return the sequence of `parts`."""
    return Concatenation(parts)


def leaves(document: Document) -> Iterator[Leaf]:
    """Yield the leaves of a document in order."""
    match document:
        case Indent(body=body) | DocumentGroup(body=body):
            yield from leaves(body)
        case Concatenation(parts=parts):
            for part in parts:
                yield from leaves(part)
        case _:
            yield document


def has_comment(document: Document) -> bool:
    """Whether a comment forces a line break in a document; a trailing comment after its last text does not."""
    remarked = False
    for leaf in leaves(document):
        if isinstance(leaf, CommentLine) or (remarked and isinstance(leaf, Fragment)):
            return True
        remarked = remarked or isinstance(leaf, TrailingComment)
    return False
