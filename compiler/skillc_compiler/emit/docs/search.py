"""What the search box of the reference finds."""

from __future__ import annotations

import json
from collections.abc import Iterator

from skillc_compiler.emit.docs.linking import anchor
from skillc_compiler.library.skills import SkillLibrary

PLACE = "[/* entries */]"


def script(template: str, library: SkillLibrary, terms: frozenset[str]) -> str:
    """Return the script with an entry for each skill, task and term: its name, its kind, its page."""
    entries = json.dumps(sorted(_entries(library, terms)), ensure_ascii=False, indent=0)
    return template.replace(PLACE, entries)


def _entries(library: SkillLibrary, terms: frozenset[str]) -> Iterator[tuple[str, str, str]]:
    vocabulary = library.vocabulary
    yield from ((name, "skill", f"skill/{name}.html") for name in library.skills)
    yield from ((name, "task", f"tasks.html#{name}") for name in library.tasks)
    kinds = (
        ("class", vocabulary.classes),
        ("relation", vocabulary.relations),
        ("property", vocabulary.properties),
        ("function", vocabulary.functions),
    )
    for kind, table in kinds:
        for name in terms & table.keys():
            yield vocabulary.short(name), kind, f"terms.html#{anchor(name, vocabulary)}"
