"""Printing to the terminal: results to stdout, everything else to stderr. Nothing heavy is imported here."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TextIO

import click

from skillc.cli.layout import TerminalPage
from skillc.cli.settings import output_settings
from skillc.errors import RequestError
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.encoding import MOST_BYTES
from skillc_dsl.source import Source

if TYPE_CHECKING:
    from rich.console import Console

LEAST_WIDTH = 40
"""The least width for which text is laid out; narrower terminals wrap the rest themselves."""


class Terminal:
    """Prints the messages of services to stderr; if the command is quiet, only warnings and errors."""

    def say(self, message: str) -> None:
        """Print a message: `error: ..`, `warning: ..`, or a remark."""
        if message.startswith("error: "):
            print_error(message.removeprefix("error: "))
        elif message.startswith("warning: "):
            print_labelled("warning", message.removeprefix("warning: "))
        else:
            print_remark(message)

    def show(self, diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source]) -> None:
        """Print diagnostics in full."""
        from skillc_dsl.rendering.full import render

        text = render(diagnostics, texts, colour=has_colours(sys.stderr), width=page_width(sys.stderr))
        if text:
            print_talk(*text.removesuffix("\n").split("\n"))


def print_talk(*lines: str) -> None:
    """Print lines that were laid out for the page of stderr, above a display that changes."""
    for line in lines:
        print(line, file=sys.stderr, flush=True)  # click would write to the stream below a live display


def print_result(text: str) -> None:
    """Print a text that was laid out for the page of stdout."""
    click.echo(text, color=True)


def print_lines(lines: Iterable[str]) -> None:
    """Print lines that were laid out for the page of stdout."""
    for line in lines:
        click.echo(line, color=True)


def print_text(text: str) -> None:
    """Print a result; lines that are wider than the page go on below, with a hanging indent."""
    page = page_of(sys.stdout)
    for line in text.split("\n"):
        body = line.lstrip(" ")
        margin = " " * (len(line) - len(body))
        for part in page.wrap(body, indent=margin, hanging=f"{margin}    "):
            click.echo(part)


def print_remark(text: str) -> None:
    """Print what is not a result, such as a count or the next steps, to stderr, unless the command is quiet."""
    if not output_settings().quiet:
        print_talk(*page_of(sys.stderr).wrap(text, hanging="  "))


def remark_default(named: str | None, chosen: str | None) -> None:
    """Say which task was taken if none was named."""
    if named is None and chosen is not None:
        print_remark(f"task `{chosen}`, the default one of this project")


def print_error(message: str) -> None:
    """Print why a command fails to stderr."""
    print_labelled("error", message)


def print_labelled(severity: str, message: str) -> None:
    """Print an error or a warning to stderr."""
    page = page_of(sys.stderr)
    label = page.paint(f"{severity}:", "bad" if severity == "error" else "warning")
    first, *rest = page.wrap(f"{severity}: {message}", hanging="  ")
    print_talk(f"{label}{first.removeprefix(f'{severity}:')}", *rest)


def print_json(value: Any) -> None:
    """Print plain data, or data that msgspec encodes, as one JSON document."""
    import msgspec

    encoded = msgspec.json.format(msgspec.json.encode(value), indent=2).decode()
    click.echo(encoded if is_unicode(sys.stdout) else json.dumps(json.loads(encoded), indent=2))


def page_of(stream: TextIO) -> TerminalPage:
    """Return the page that a stream prints on."""
    return TerminalPage(page_width(stream), has_colours(stream))


def rich_console(stream: TextIO) -> Console:
    """Return a console for live displays on a stream, which prints text unchanged: names may look like markup.

    Spinners and columns of progress bars parse markup even with such a console: give them a `Text`.
    """
    from rich.console import Console

    return Console(
        file=stream,
        force_terminal=stream.isatty(),
        color_system="standard" if has_colours(stream) else None,
        legacy_windows=False,
        width=page_width(stream),
        highlight=False,
        markup=False,
        emoji=False,
    )


def has_colours(stream: TextIO) -> bool:
    """Whether to use colours: as --color says, never with NO_COLOR, always with FORCE_COLOR, else on a terminal."""
    wanted = output_settings().color
    if wanted != "auto":
        return wanted == "always"
    if os.environ.get("NO_COLOR"):
        return False
    return bool(os.environ.get("FORCE_COLOR")) or (stream.isatty() and os.environ.get("TERM") != "dumb")


def find_display_obstacle() -> str | None:
    """Return why stderr shows no display that changes; None if it shows one."""
    if output_settings().quiet:
        return "--quiet is given"
    if os.environ.get("CI"):
        return "the environment variable CI is set"
    if not sys.stderr.isatty():
        return "stderr is not a terminal"
    return "the terminal is dumb (TERM)" if os.environ.get("TERM") == "dumb" else None


def is_unicode(stream: TextIO) -> bool:
    """Whether a stream takes all characters, and not only those of an old encoding such as ASCII."""
    return (getattr(stream, "encoding", None) or "").lower().replace("-", "").startswith("utf")


def page_width(stream: TextIO) -> int | None:
    """Return the width of the terminal in cells, or COLUMNS if it is set; None if the output has no width."""
    if not stream.isatty() and not os.environ.get("COLUMNS", "").isdigit():
        return None
    import shutil

    return max(shutil.get_terminal_size().columns, LEAST_WIDTH)


def read_stdin() -> bytes:
    """Return the bytes of the standard input, at most MOST_BYTES; RequestError if it cannot be read."""
    try:
        return sys.stdin.buffer.read(MOST_BYTES)  # wait ends: when the input is closed
    except OSError as error:
        raise RequestError(f"the standard input cannot be read: {error.strerror}") from error
