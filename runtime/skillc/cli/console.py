"""Printing to the terminal: results to stdout, everything else to stderr. Nothing heavy is imported here."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TextIO

import click

from skillc.services.errors import RequestError
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.encoding import MOST_BYTES
from skillc_dsl.source import Source

if TYPE_CHECKING:
    from rich.console import Console


class Terminal:
    """Prints the messages of services to stderr."""

    def say(self, message: str) -> None:
        """Print a line."""
        click.echo(message, err=True)

    def show(self, diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source]) -> None:
        """Print diagnostics in full."""
        from skillc_dsl.rendering.full import render

        text = render(diagnostics, texts, colour=has_colours(sys.stderr), width=page_width(sys.stderr))
        click.echo(text, err=True, nl=False, color=True)


def print_json(value: Any) -> None:
    """Print plain data, or data that msgspec encodes, as one JSON document."""
    import msgspec

    click.echo(msgspec.json.format(msgspec.json.encode(value), indent=2).decode())


def rich_console(stderr: bool = False, quiet: bool = False) -> Console:
    """Return a console that prints text unchanged: goals, names and paths may look like markup.

    Spinners and columns of progress bars parse markup even with such a console: give them a `Text`.
    """
    from rich.console import Console

    return Console(stderr=stderr, quiet=quiet, highlight=False, markup=False, emoji=False)


def has_colours(stream: TextIO) -> bool:
    """Whether to use colours: on a terminal that supports them, always with FORCE_COLOR, never with NO_COLOR."""
    if os.environ.get("NO_COLOR"):
        return False
    return bool(os.environ.get("FORCE_COLOR")) or (stream.isatty() and os.environ.get("TERM") != "dumb")


def page_width(stream: TextIO) -> int | None:
    """Return the width of the terminal in cells, or COLUMNS if it is set; None if the output has no width."""
    if not stream.isatty() and not os.environ.get("COLUMNS", "").isdigit():
        return None
    return max(shutil.get_terminal_size().columns, 40)


def read_stdin() -> bytes:
    """Return the bytes of the standard input, at most MOST_BYTES; RequestError if it cannot be read."""
    try:
        return sys.stdin.buffer.read(MOST_BYTES)  # wait ends: when the input is closed
    except OSError as error:
        raise RequestError(f"the standard input cannot be read: {error.strerror}") from error
