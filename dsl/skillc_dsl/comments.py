"""The comments of a file, which its syntax tree omits."""

from __future__ import annotations

import re

import msgspec

from skillc_dsl.source import Source, Span
from skillc_dsl.token_table import PATTERNS

_COMMENT_OR_LIKE = re.compile(rf'"[^"\n]*"?|{PATTERNS["address"]}|(?P<comment>{PATTERNS["comment"]})')


class Comment(msgspec.Struct, frozen=True):
    """A comment as written, from its `#` to the end of its line without the white space there.

    `alone` distinguishes one with a line of its own from one after something else.
    """

    written: str
    alone: bool
    span: Span

    @property
    def text(self) -> str:
        """What it says, without its marks."""
        return self.written.lstrip("#").strip()


def find_comments(source: Source) -> tuple[Comment, ...]:
    """Return the comments of `source` in their order; a `#` in a text or in an address begins none."""
    found: list[Comment] = []
    for number, line in enumerate(source.text.split("\n"), 1):
        if "#" not in line:
            continue
        match = next((m for m in _COMMENT_OR_LIKE.finditer(line) if m["comment"]), None)
        if match is not None:
            written, column = match["comment"].rstrip(), match.start() + 1
            span = Span(source.path, number, column, number, column + len(written))
            found.append(Comment(written, not line[: match.start()].strip(), span))
    return tuple(found)
