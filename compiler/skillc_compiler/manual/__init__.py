"""The manual: NAME.md beside this file explains the diagnostic NAME, and its two examples are run by the tests.

A page has two fields, the name, a sentence, the reason with advice, an example with this problem, one without:

    ---
    family: quantities
    found-by: compiler
    ---

    # missing-unit

    A number has no unit.

    A bare number can be read as millimetres as well as metres.

    ```skill bad
    ...
    ```

    ```skill good
    ...
    ```
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

import msgspec

FAMILIES = (
    *("text", "quantities", "scenes", "properties", "implementations", "data flow", "planning", "ontology", "names"),
    *("logic", "projects", "tests"),
)
FINDERS = ("compiler", "vocabulary", "scene", "check", "formatter", "goal", "pddl", "project", "test")
_FOLDER = Path(__file__).parent
_PAGE = re.compile(
    r"---\nfamily: (?P<family>.+)\nfound-by: (?P<found_by>.+)\n---\n\n"
    r"# (?P<name>[a-z-]+)\n\n(?P<title>.+)\.\n\n(?P<prose>(?:(?!```).*\n)*?(?!```).+)\n\n"
    r"```(?P<language>skill|turtle|toml|lisp) bad\n(?P<bad>(?:(?!```).*\n)+)```\n\n"
    r"```(?P=language) good\n(?P<good>(?:(?!```).*\n)+)```\n"
)


class Page(msgspec.Struct, frozen=True):
    """The explanation of a diagnostic.

    `family` is the heading under which it is listed; `found_by` is the part that reports it: the compiler, the loaders
    of vocabularies and scenes, `skillc check` of a library with its scenes, the formatter, the parser of goals from the
    command line, the reader of projects, or `skillc test`. `title` is a sentence without its full stop, `prose` is
    Markdown. `bad` is a whole file with this problem and no other, `good` a file without problems; both are in
    `language`.
    """

    name: str
    family: str
    found_by: str
    title: str
    prose: str
    language: str
    bad: str
    good: str


@cache
def page_names() -> frozenset[str]:
    """Return the names of all diagnostics."""
    return frozenset(path.stem for path in _FOLDER.glob("*.md"))


@cache
def load_pages() -> Mapping[str, Page]:
    """Return the pages of all diagnostics by name, in alphabetical order."""
    return MappingProxyType({name: load_page(name) for name in sorted(page_names())})


@cache
def load_page(name: str) -> Page:
    """Return the page of a diagnostic; raise ValueError if it has the wrong form."""
    return parse_page(name, (_FOLDER / f"{name}.md").read_text("utf-8"))


def parse_page(name: str, text: str) -> Page:
    """Return the page in the text of the file NAME.md; raise ValueError if it has the wrong form."""
    match = _PAGE.fullmatch(text)
    if match is None:
        raise ValueError(f"{name}.md is not of the form that {__name__} documents")
    found = Page(**match.groupdict())
    if found.name != name:
        raise ValueError(f"{name}.md explains `{found.name}`")
    for value, known in ((found.family, FAMILIES), (found.found_by, FINDERS)):
        if value not in known:
            raise ValueError(f"{name}.md says `{value}`, which is none of {', '.join(known)}")
    return found


def group_by_family(shown: Iterable[Page]) -> Mapping[str, tuple[Page, ...]]:
    """Return pages in alphabetical order by family, the families in the order of `FAMILIES`."""
    ordered = sorted(shown, key=lambda each: each.name)
    grouped = {family: tuple(each for each in ordered if each.family == family) for family in FAMILIES}
    return {family: members for family, members in grouped.items() if members}
