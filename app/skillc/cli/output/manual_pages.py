"""Formats pages of the manual of diagnostics for the terminal."""

from __future__ import annotations

import sys
import textwrap
from collections.abc import Iterator, Mapping

import click

from skillc.cli.console import has_colours, page_width
from skillc_compiler.manual import Page, group_by_family

_WIDEST = 100
"""The greatest width of a line of prose, in cells."""


def format_page(shown: Page) -> str:
    """Return a page as text, in colours if the terminal supports them."""
    first, *rest = textwrap.wrap(f"{shown.name}: {shown.title}", _width(), subsequent_indent="  ")
    head = f"{_styled(shown.name, fg='cyan')}{first.removeprefix(shown.name)}"
    lines = [head, *rest, f"family: {shown.family}", ""]
    for paragraph in filter(None, shown.prose.split("\n\n")):
        lines += [*_paragraph(paragraph), ""]
    lines += [_styled("Bad", fg="red"), "", *_indented(shown.bad), ""]
    lines += [_styled("Good", fg="green"), "", *_indented(shown.good)]
    return "".join(f"{line}\n" for line in lines)


def format_contents(pages: Mapping[str, Page]) -> str:
    """Return the names and titles of all pages by family."""
    widest = max(len(name) for name in pages)
    lines: list[str] = []
    for family, members in group_by_family(pages.values()).items():
        lines.append(_styled(family, fg="cyan"))
        for each in members:
            first, *rest = textwrap.wrap(each.title, max(_width() - widest - 4, 24))
            lines.append(f"  {each.name:{widest}}  {first}")
            lines += (f"  {'':{widest}}  {line}" for line in rest)
        lines.append("")
    return "".join(f"{line}\n" for line in (*lines, "skillc explain NAME shows a page with examples."))


def _paragraph(text: str) -> Iterator[str]:
    """Yield a paragraph wrapped to the page's width; indented text and lists are not wrapped."""
    lines = text.split("\n")
    if any(line.startswith((" ", "- ", "* ", "|")) for line in lines):
        yield from lines
    else:
        yield from textwrap.wrap(" ".join(lines), _width(), break_long_words=False, break_on_hyphens=False)


def _indented(program: str) -> list[str]:
    return [f"    {line}".rstrip() for line in program.rstrip("\n").split("\n")]


def _width() -> int:
    return min(page_width(sys.stdout) or _WIDEST, _WIDEST)


def _styled(text: str, *, fg: str) -> str:
    return click.style(text, fg=fg, bold=True) if has_colours(sys.stdout) else text
