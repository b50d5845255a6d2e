"""Documents: text with the places where lines may or must break."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

import msgspec


class Fragment(msgspec.Struct, frozen=True):
    """Text that is never broken."""

    text: str


class Gap(msgspec.Struct, frozen=True):
    """A space between two texts of one line."""


class SoftBreak(msgspec.Struct, frozen=True):
    """A line break if the enclosing group does not fit its line; otherwise the text `flat`."""

    flat: str = " "


class HardBreak(msgspec.Struct, frozen=True):
    """A line break."""


class BlankLine(msgspec.Struct, frozen=True):
    """One blank line before the next text, where a blank line is allowed."""


class TrailingComment(msgspec.Struct, frozen=True):
    """A comment at the end of its line."""

    text: str


class CommentLine(msgspec.Struct, frozen=True):
    """A comment on a line of its own."""

    text: str


class Punctuation(msgspec.Struct, frozen=True):
    """A comma or an opening brace: it stays on the line of the preceding text, before any comment."""

    text: str


class WhenBroken(msgspec.Struct, frozen=True):
    """Text that is only written if the enclosing group breaks."""

    text: str


class Indent(msgspec.Struct, frozen=True):
    """A document whose lines after the first are indented by one step."""

    body: Document


class DocumentGroup(msgspec.Struct, frozen=True):
    """A document on one line if it fits; otherwise each `SoftBreak` that is not in an inner group breaks."""

    body: Document


class Concatenation(msgspec.Struct, frozen=True):
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
