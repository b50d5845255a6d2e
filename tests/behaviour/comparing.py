"""Compares two saved behaviours file by file."""

from __future__ import annotations

import difflib
import json
import re
from collections.abc import Iterator
from pathlib import Path

from behaviour.normalising import normalise

ABOUT = "about.json"
"""The file of a saved behaviour that says of which product it is, and from where."""
SHOWN_FILES, SHOWN_LINES, WIDTH = 8, 24, 180
"""How much is shown: files of a kind, lines of a file, characters of a line."""


def compare(before: Path, after: Path) -> dict[str, list[str]]:
    """Return the lines that tell what differs in each kind that both have; none where it is the same."""
    kinds = _list_kinds(before) & _list_kinds(after)
    return {kind: list(_tell(_read(before, kind), _read(after, kind))) for kind in sorted(kinds)}


def missing(before: Path, after: Path) -> list[str]:
    """Return the kinds that only one of two saved behaviours has."""
    return sorted(_list_kinds(before) ^ _list_kinds(after))


def _list_kinds(saved: Path) -> set[str]:
    return {each.name for each in saved.iterdir() if each.is_dir()}


def _read(saved: Path, kind: str) -> dict[str, str]:
    roots = json.loads((saved / ABOUT).read_text("utf-8"))[kind]["roots"]
    files = (path for path in sorted((saved / kind).rglob("*")) if path.is_file())
    return {path.relative_to(saved / kind).as_posix(): normalise(path.read_text("utf-8"), roots) for path in files}


def _tell(before: dict[str, str], after: dict[str, str]) -> Iterator[str]:
    different = sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))
    if different:
        yield f"{len(different)} of {len(before.keys() | after.keys())} files differ"
    for name in different[:SHOWN_FILES]:
        match before.get(name), after.get(name):
            case None, _:
                yield f"+++ {name} is new"
            case _, None:
                yield f"--- {name} is missing"
            case old, new:
                yield from _differences(name, old or "", new or "")
    if len(different) > SHOWN_FILES:
        yield f"and in {len(different) - SHOWN_FILES} more files: {', '.join(different[SHOWN_FILES:])[:WIDTH]}"


def _differences(name: str, before: str, after: str) -> Iterator[str]:
    lines = list(difflib.unified_diff(_split(before), _split(after), name, name, n=1, lineterm=""))
    yield from (_shorten(line) for line in lines[:SHOWN_LINES])
    if len(lines) > SHOWN_LINES:
        yield f"    and {len(lines) - SHOWN_LINES} more lines"


def _split(text: str) -> list[str]:
    """Return the lines of a text; long ones, such as an event or a signature, in the parts between their commas."""
    lines = text.splitlines()
    return [part for line in lines for part in (re.split(r"(?<=,)", line) if len(line) > WIDTH else [line])]


def _shorten(line: str) -> str:
    return line if len(line) <= WIDTH else f"{line[: WIDTH - 3]}..."
