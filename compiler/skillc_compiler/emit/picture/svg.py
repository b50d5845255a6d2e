"""Pictures as SVG: plain shapes and text without external fonts or scripts, legible on light and dark backgrounds."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from xml.sax.saxutils import escape, quoteattr

from skillc_compiler.emit.picture.boxes import PictureBox
from skillc_compiler.emit.picture.layout import LINE, PADDING, SYMBOL, PlacedBox, lay_out, picture_size

STYLE = """\
.picture { --ink: #1c2128; --link: #0550ae; --line: #8b949e; --paper: #ffffff; --heading: #e7e9ed;
  --flow: #d9e8fb; --guard: #fdecc8; --call: #d8f0dc; --time: #e8defa; --code: #f9dcd9; }
@media (prefers-color-scheme: dark) {
  .picture { --ink: #e6edf3; --link: #79b8ff; --line: #768390; --paper: #161b22; --heading: #373e47;
    --flow: #1d3b63; --guard: #56420f; --call: #1b4a2b; --time: #46306f; --code: #67302c; }
}
.picture text { font: 12px ui-monospace, "DejaVu Sans Mono", "Liberation Mono", Menlo, Consolas, monospace;
  fill: var(--ink); white-space: pre; }
.picture .title { font-weight: bold; }
.picture a text { fill: var(--link); text-decoration: underline; }
.picture .symbol { font-size: 14px; text-anchor: middle; }
.picture path { fill: none; stroke: var(--line); shape-rendering: crispEdges; }
.picture rect.box { fill: var(--paper); stroke: var(--line); stroke-width: 1.3; }
.picture rect.heading { fill: var(--heading); } .picture rect.flow { fill: var(--flow); }
.picture rect.guard { fill: var(--guard); } .picture rect.call { fill: var(--call); }
.picture rect.time { fill: var(--time); } .picture rect.code { fill: var(--code); }
"""
"""Style sheet for pages that contain pictures."""


def draw(box: PictureBox, href: Callable[[str], str | None]) -> str:
    """Return the picture as an SVG element for a page that has `STYLE`; screen readers read its title.

    `href` returns the address of a called skill's page, None if it has no page.
    """
    return _element(box, "", href)


def draw_document(box: PictureBox) -> str:
    """Return the picture as an SVG file."""
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{_element(box, f"<style>{escape(STYLE)}</style>", _nowhere)}\n'


def _nowhere(_skill: str) -> None:
    """Return None: a picture in a file of its own has no links."""


def _element(box: PictureBox, style: str, href: Callable[[str], str | None]) -> str:
    placed = lay_out(box)
    width, height = picture_size(placed)
    size = f'width="{width}" height="{height}" viewBox="0 0 {width} {height}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" class="picture" role="group" {size}>'
    parts = [head, f"<title>{escape(box.title)}</title>", style]
    parts += [line for each in placed for line in _connection(each)]
    parts += [line for each in placed for line in _box(each, href(each.called) if each.called else None)]
    return "\n".join(part for part in (*parts, "</svg>") if part)


def _connection(box: PlacedBox) -> Iterator[str]:
    if box.parent is not None:
        x, y = box.parent
        middle = box.y + PADDING + LINE / 2
        yield f'<path d="M {x:g} {y:g} V {middle:g} H {box.x:g}"/>'


def _box(box: PlacedBox, href: str | None) -> Iterator[str]:
    frame = f'x="{box.x:g}" y="{box.y:g}" height="{box.height:g}" rx="4"'
    yield f'<rect class="box" {frame} width="{box.width:g}"/>'
    yield f'<rect class="{box.look}" {frame} width="{SYMBOL}"/>'
    first = box.y + PADDING + LINE - 5
    yield f'<text class="symbol" x="{box.x + SYMBOL / 2:g}" y="{first:g}">{escape(box.symbol)}</text>'
    rows = [("title", line) for line in box.title] + [("line", line) for line in box.lines]
    for row, (kind, line) in enumerate(rows):
        x, y = box.x + SYMBOL + PADDING, first + row * LINE
        text = f'<text class="{kind}" x="{x:g}" y="{y:g}">{escape(line)}</text>'
        yield f"<a href={quoteattr(href)}>{text}</a>" if href and kind == "title" else text
