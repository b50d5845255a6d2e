"""Alignment of the lines of a block: each cell is padded to the width of its column."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from skillc_dsl.formatting import documents as d
from skillc_dsl.formatting.layout import one_line

KEYWORD = "keyword"


class ColumnCell(msgspec.Struct, frozen=True):
    """A piece of a line in the column of the given name, followed by `gap` spaces.

    A `loose` cell does not widen its column.
    """

    column: str
    content: d.Document
    gap: int = 1
    loose: bool = False


class MemberLine(msgspec.Struct, frozen=True):
    """A member: the comments above it, its cells, and the rest, which is not aligned."""

    above: d.Document
    cells: tuple[ColumnCell, ...]
    rest: d.Document


def align_columns(members: Sequence[MemberLine], least: int = 0) -> Iterator[d.Document]:
    """Yield each member with its cells padded; the column of keywords is at least `least` wide.

    A member with a comment among its cells is not aligned.
    """
    texts = [_texts(member) for member in members]
    widths = {KEYWORD: least}
    for member, row in zip(members, texts, strict=True):
        for cell, text in zip(member.cells, row, strict=False):
            if not cell.loose:
                widths[cell.column] = max(widths.get(cell.column, 0), len(text))
    for member, row in zip(members, texts, strict=True):
        if len(row) < len(member.cells):
            loose = (part for cell in member.cells for part in (cell.content, d.Gap()))
            yield d.concatenate(member.above, *loose, member.rest)
        else:
            cells = zip(member.cells, row, strict=True)
            padded = "".join(f"{text:<{widths.get(cell.column, 0)}}{' ' * cell.gap}" for cell, text in cells)
            yield d.concatenate(member.above, *([d.Fragment(padded)] if padded else []), member.rest)


def _texts(member: MemberLine) -> tuple[str, ...]:
    """Return the texts of all cells, or an empty tuple if a cell does not fit one line or has a comment."""
    texts = [one_line(cell.content) for cell in member.cells]
    return () if None in texts else tuple(text or "" for text in texts)
