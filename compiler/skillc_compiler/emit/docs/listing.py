"""Source files as HTML lines, with keywords and comments highlighted."""

from __future__ import annotations

from collections.abc import Iterator

from markupsafe import Markup

from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.rendering.printable import printable
from skillc_dsl.source import Source

VALUES = frozenset({"STRING", "QUANTITY", "NUMBER"})


def format_listing(source: Source) -> tuple[Markup, ...]:
    """Return the lines of a file, without line numbers."""
    marked = Markup("").join(_pieces(source.text, _stretches(source)))
    return tuple(Markup(line) for line in marked.split("\n"))


def format_excerpt(source: Source, first: int, last: int) -> Markup:
    """Return the lines `first` to `last` of a file, counted from 1, both included."""
    return Markup("\n").join(format_listing(source)[first - 1 : last])


def _stretches(source: Source) -> Iterator[tuple[int, int, str]]:
    """Yield start, end and kind of the highlighted ranges, in order."""
    end = 0
    for token in tokenize(source).value:
        start = token.start_pos or 0
        yield from _comments(source.text, end, start if token else len(source.text))
        end = token.end_pos or 0
        if token.type == token.upper() and token.type != "NAME":
            yield start, end, "keyword"
        elif token.type in VALUES:
            yield start, end, "value"


def _comments(text: str, start: int, end: int) -> Iterator[tuple[int, int, str]]:
    """Yield the comments between two tokens, one range per line."""
    position = text.find("#", start, end)
    while position >= 0:
        stop = text.find("\n", position, end)
        stop = end if stop < 0 else stop
        yield position, stop, "doc" if text.startswith("##", position) else "comment"
        position = text.find("#", stop, end)


def _pieces(text: str, stretches: Iterator[tuple[int, int, str]]) -> Iterator[Markup]:
    position = 0
    for start, end, kind in stretches:
        yield Markup.escape(printable(text[position:start]))
        yield Markup('<span class="{}">{}</span>').format(kind, printable(text[start:end]))
        position = end
    yield Markup.escape(printable(text[position:]))
