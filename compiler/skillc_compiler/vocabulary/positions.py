"""Where a Turtle file speaks of a term. RDF parsers keep no places, so the text is searched."""

from __future__ import annotations

import re
from collections.abc import Iterable

from skillc_compiler.library.vocabulary import Position
from skillc_dsl.source import Source

_PREFIX = re.compile(r"@prefix\s+([\w-]*):\s*<([^>]*)>")
_SUBJECT = re.compile(r"^(?:([\w-]*):([\w-]+)|<([^>]+)>)\s+(a\b)?", re.MULTILINE)


def positions(sources: Iterable[Source]) -> dict[str, Position]:
    """Return for each subject at a line's start where it is declared (`a ..`), else where it first stands."""
    found: dict[str, tuple[bool, Position]] = {}
    for source in sources:
        prefixes = dict(_PREFIX.findall(source.text))
        line, seen = 1, 0
        for match in _SUBJECT.finditer(source.text):
            line += source.text.count("\n", seen, match.start())
            seen = match.start()
            prefix, local, iri, declared = match.groups()
            subject = iri or prefixes.get(prefix, "") + local
            if subject not in found or (declared and not found[subject][0]):
                found[subject] = (bool(declared), Position(source.path, line, 1))
    return {subject: position for subject, (_, position) in found.items()}
