"""The order of the pages: the sections and tables of docs/README.md are the navigation of the site."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

HEADING = re.compile(r"^## (.+)$")
ROW = re.compile(r"^\| \[([^\]]+)\]\(([^)#]+)\)")
OVERVIEW = "overview.md"
"""The name in the site of docs/README.md."""
ELSEWHERE = {"../editors/README.md": "editors.md"}
ELSEWHERE |= {"../CONTRIBUTING.md": "contributing.md", "../CHANGELOG.md": "changelog.md"}


@dataclass(frozen=True, slots=True)
class Section:
    """A section with its pages, each a title and a path relative to docs/."""

    title: str
    pages: tuple[tuple[str, str], ...]


def find_pages(docs: Path) -> list[str]:
    """Return the paths of all Markdown pages in a folder, relative to it, but not those in skillc_site."""
    paths = sorted(path.relative_to(docs).as_posix() for path in docs.rglob("*.md"))
    return [path for path in paths if not path.startswith("skillc_site/")]


def read_sections(index: Path, further: Mapping[str, tuple[tuple[str, str], ...]]) -> tuple[Section, ...]:
    """Return the sections of the page that lists all pages; `further` has pages to add, by the title of a section."""
    found: list[tuple[str, list[tuple[str, str]]]] = []
    for line in index.read_text("utf-8").splitlines():
        if heading := HEADING.match(line):
            found.append((heading[1], []))
        elif (row := ROW.match(line)) and found:
            found[-1][1].append((row[1], ELSEWHERE.get(row[2], row[2])))
    return tuple(Section(title, (*pages, *further.get(title, ()))) for title, pages in found if pages)


def toml_of(sections: tuple[Section, ...]) -> str:
    """Return the sections as a TOML array of tables, the way Zensical reads its navigation."""
    entries = [f"{{ {json.dumps(each.title)} = [{_pages(each)}] }}" for each in sections]
    return f'[{{ "skillc" = "index.md" }}, {{ "All pages" = "{OVERVIEW}" }}, {", ".join(entries)}]'


def _pages(section: Section) -> str:
    return ", ".join(f"{{ {json.dumps(title)} = {json.dumps(path)} }}" for title, path in section.pages)
