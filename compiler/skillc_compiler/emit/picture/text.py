"""Pictures as indented text, for terminals."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.emit.picture.boxes import PictureBox
from skillc_compiler.emit.picture.wrapping import wrap_text

NARROWEST = 24
"""The minimum width of a box in cells, however deep it is nested."""


def draw(box: PictureBox, width: int) -> str:
    """Return the picture as a tree of lines of at most `width` cells, unless it is nested too deep for that."""
    return "".join(f"{line.rstrip()}\n" for line in _lines(box, "", "", width))


def _lines(box: PictureBox, first: str, rest: str, width: int) -> Iterator[str]:
    """Yield the lines of a box, the first one behind `first` and the others behind `rest`."""
    below = rest + ("│ " if box.children else "  ")
    room = max(NARROWEST, width - len(below))
    title, *wrapped = wrap_text(f"{box.symbol} {box.title}", room)
    yield first + title
    yield from (below + line for line in wrapped)
    yield from (below + line for text in box.lines for line in wrap_text(text, room))
    for child in box.children:
        is_last = child is box.children[-1]
        yield from _lines(child, rest + ("└─" if is_last else "├─"), rest + ("  " if is_last else "│ "), width)
