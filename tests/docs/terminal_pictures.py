"""Draws terminals of two widths in which a project is checked, planned and run, for docs/terminal.md."""

from __future__ import annotations

import io
import os
import re
import sys
import tempfile
from collections.abc import Iterable, Iterator
from itertools import groupby
from pathlib import Path

from pyte.screens import Char
from rich.console import CONSOLE_SVG_FORMAT, Console
from rich.style import Style
from rich.terminal_theme import DEFAULT_TERMINAL_THEME
from rich.text import Text

from docs.pages import ROOT
from operating.terminal import Line, Terminal, text_of

WIDTHS = (80, 160)
COMMANDS = ("new cell --template pick-place -q", "check", "plan", "run --backend kinematic", "trials -n 3 --jobs 1")
WRONG = "check"
"""The command before which a name is misspelt; it is corrected after it."""
FONTS = re.compile(r"@font-face \{\{.*?\}\}", re.DOTALL)
COLOURS = {"brown": "yellow"}
"""Names of colours that differ between the libraries."""


def picture_file(columns: int) -> Path:
    """Return the file of the picture of a terminal with so many columns."""
    return ROOT / f"docs/pictures/terminal-{columns}.svg"


def run_session(folder: Path, columns: int) -> list[Text]:
    """Carry out the commands in a terminal of so many columns; return its lines."""
    shown = list[Text]()
    for command in COMMANDS:
        here = folder / "cell" if (folder / "cell").exists() else folder
        if command == WRONG:
            _replace(here / "tasks.skill", "lab:Box-A contain", "lab:Box-A contian")
        with Terminal((sys.executable, "-m", "skillc", *command.split()), dict(os.environ), columns, here) as terminal:
            terminal.wait()
            lines = terminal.lines
        if command == WRONG:
            _replace(here / "tasks.skill", "contian", "contain")
        shown += [Text(f"$ skillc {command}", "bold"), *map(_style, lines), Text()]
    return shown


def draw(lines: Iterable[Text], columns: int) -> str:
    """Return the picture of lines, without the fonts that it would load from elsewhere."""
    console = Console(record=True, width=columns, file=io.StringIO(), legacy_windows=False)
    for line in lines:
        console.print(line, overflow="ignore", no_wrap=True, crop=True)
    code = FONTS.sub("", CONSOLE_SVG_FORMAT)
    return console.export_svg(
        title=f"{columns} columns", unique_id=f"terminal-{columns}", theme=DEFAULT_TERMINAL_THEME, code_format=code
    )


def write_terminal_pictures() -> Iterator[Path]:
    """Write all pictures, and yield their files."""
    for columns in WIDTHS:
        with tempfile.TemporaryDirectory() as folder:
            lines = run_session(Path(folder), columns)
        picture_file(columns).write_text(draw(lines, columns), encoding="utf-8")
        yield picture_file(columns)


def _replace(file: Path, old: str, new: str) -> None:
    text = file.read_text("utf-8")
    assert old in text, file
    file.write_text(text.replace(old, new, 1), "utf-8")


def _style(line: Line) -> Text:
    text = Text()
    for style, chars in groupby(line[: len(text_of(line))], _style_of):
        text.append("".join(each.data for each in chars), style)
    return text


def _style_of(char: Char) -> Style:
    colour = None if char.fg == "default" else COLOURS.get(char.fg, char.fg.replace("bright", "bright_"))
    return Style(color=colour, bold=char.bold, underline=char.underscore)
