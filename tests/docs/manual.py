"""The list of all diagnostics for readers of the documentation, made from the pages that `skillc explain` shows."""

from __future__ import annotations

from collections.abc import Iterator

from docs.pages import ROOT
from skillc_compiler.manual import Page, group_by_family, load_pages

MANUAL = ROOT / "docs/diagnostics.md"
INTRODUCTION = """\
# What the compiler finds

Made by `make accept` from the pages that `skillc explain NAME` shows; the tests run every example. The first example
of each page has the problem, the second has none.
"""


def manual() -> str:
    """Return the text of the page."""
    families = group_by_family(load_pages().values())
    lines = [INTRODUCTION]
    for family, members in families.items():
        lines += [f"- **{family}**: {', '.join(f'[{each.name}](#{each.name})' for each in members)}"]
    for family, members in families.items():
        lines += ["", f"## {family.capitalize()}"]
        lines += [line for each in members for line in _page(each)]
    return "\n".join(lines) + "\n"


def _page(page: Page) -> Iterator[str]:
    yield from ("", f"### {page.name}", "", f"{page.title}.", "", page.prose, "")
    for kind, program in (("bad", page.bad), ("good", page.good)):
        yield from (f"```{page.language} {kind}", program.rstrip("\n"), "```")
