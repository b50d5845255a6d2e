"""Pictures as Mermaid flow charts, which many wikis and code hosts render."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count

from skillc_compiler.emit.picture.boxes import PictureBox
from skillc_compiler.emit.picture.wrapping import wrap_text

WIDEST = 40
"""Maximum width of a line, in cells."""
OUTSIDE = {"#": "#35;", '"': "#quot;", "<": "#lt;", ">": "#gt;", "&": "#amp;", "`": "#96;"}
"""Mermaid's escapes of characters that are special in Mermaid or HTML."""


def draw(box: PictureBox) -> str:
    """Return the picture as the text of a Mermaid diagram."""
    return "flowchart TD\n" + "".join(f"  {line}\n" for line in _lines(box, "n0", count(1)))


def _lines(box: PictureBox, name: str, numbers: Iterator[int]) -> Iterator[str]:
    yield f'{name}["{_label(box)}"]'
    for child in box.children:
        other = f"n{next(numbers)}"
        yield from _lines(child, other, numbers)
        yield f"{name} --> {other}"


def _label(box: PictureBox) -> str:
    rows = [f"{box.symbol} {box.title}", *(line for text in box.lines for line in wrap_text(text, WIDEST))]
    return "<br/>".join("".join(OUTSIDE.get(character, character) for character in row) for row in rows)
