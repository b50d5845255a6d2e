"""Documentation comments (Markdown) as HTML."""

from __future__ import annotations

from functools import cache

from markdown_it import MarkdownIt
from markupsafe import Markup


def block(text: str) -> Markup:
    """Return Markdown as HTML blocks; HTML in the text is escaped, headings start at level three."""
    tokens = _markdown().parse(text)
    for token in tokens:
        if token.type in {"heading_open", "heading_close"}:
            token.tag = f"h{min(int(token.tag[1:]) + 2, 6)}"
    return Markup(_markdown().renderer.render(tokens, _markdown().options, {}))


def line(text: str) -> Markup:
    """Return the first paragraph, without `<p>` tags."""
    return Markup(_markdown().renderInline(text.split("\n\n")[0].replace("\n", " ")))


@cache
def _markdown() -> MarkdownIt:
    return MarkdownIt("commonmark", {"html": False}).enable("table")
