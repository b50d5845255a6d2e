"""Colours for terminals."""

from __future__ import annotations

from typing import Literal, NamedTuple

Kind = Literal["error", "warning", "note", "place", "label", "help"]
_COLOURS: dict[Kind, str] = {
    "error": "31",
    "warning": "33",
    "note": "34",
    "place": "36",
    "label": "34",
    "help": "32",
}


class Paint(NamedTuple):
    """Colours text for a terminal, or leaves it plain."""

    on: bool

    def __call__(self, kind: Kind, text: str) -> str:
        return f"\x1b[1;{_COLOURS[kind]}m{text}\x1b[0m" if self.on and text else text
