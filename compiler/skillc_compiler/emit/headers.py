"""Header lines of artifacts, which name the sources. A file with such a header may be replaced or removed."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from skillc_model.skills import SkillLibrary

MARK = "Made by skillc from the library"
COMMENTS = {".pddl": "; {}\n", ".ttl": "# {}\n", ".xml": "<!-- {} -->\n", ".md": "<!-- {} -->\n"}
XML_DECLARATION = '<?xml version="1.0" encoding="UTF-8"?>\n'


def add_header(path: str, text: str, library: SkillLibrary) -> str:
    """Return the text with a header in the comment syntax of its format; JSON gets none, its data has the hash."""
    comment = COMMENTS.get(PurePosixPath(path).suffix)
    if comment is None:
        return text
    line = comment.format(f"{MARK} {library.name}, sha256 {library.hash}. Change the .skill files and compile again.")
    if text.startswith(XML_DECLARATION):
        return XML_DECLARATION + line + text.removeprefix(XML_DECLARATION)
    return line + text


def is_generated(text: str) -> bool:
    """Whether the text begins with a header."""
    return any(MARK in line for line in text.splitlines()[:2])
