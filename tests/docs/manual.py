"""The list of all diagnostics for readers of the documentation, made from the pages that `skillc explain` shows."""

from __future__ import annotations

from collections.abc import Iterator

from docs.pages import ROOT
from skillc_compiler.manual import Page, pages
from skillc_compiler.manual.families import by_family

MANUAL = ROOT / "docs/diagnostics.md"
INTRODUCTION = """\
# What the compiler finds

Made by `make accept` from the pages that `skillc explain NAME` shows; the tests run every example. The first example
of each page has the problem, the second has none.
"""


def manual() -> str:
    """Return the text of the page."""
    families = by_family(pages())
    lines = [INTRODUCTION]
    for family, names in families.items():
        lines += [f"- **{family}**: {', '.join(f'[{name}](#{name})' for name in names)}"]
    for family, names in families.items():
        lines += ["", f"## {family.capitalize()}"]
        lines += [line for name in names for line in _page(pages()[name])]
    return "\n".join(lines) + "\n"


def _page(page: Page) -> Iterator[str]:
    yield from ("", f"### {page.name}", "", f"{page.title[0].upper()}{page.title[1:]}.", "")
    if page.prose:
        yield from (page.prose, "")
    for kind, program in (("bad", page.bad), ("good", page.good)):
        language = "turtle" if "@prefix" in program else "skill"
        yield from (f"```{language} {kind}", program.rstrip("\n"), "```")
