"""The manual: a page for each diagnostic, read from the docstrings of the checks and of the modules in this folder.

A docstring holds one section per diagnostic. A section begins with `## NAME: what is wrong, in a line`; without such a
line the whole docstring is the page of the module's only name, and its first line says what is wrong. Then come prose,
`Bad:` with a small program, indented, that has exactly this problem, and `Good:` with one that has none.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from inspect import getdoc
from pkgutil import iter_modules
from textwrap import dedent
from types import MappingProxyType, ModuleType

PLACES = ("skillc_compiler.checks", "skillc_compiler.manual")
_SECTION = re.compile(r"^## ([a-z-]+): (.*)$", re.MULTILINE)
_EXAMPLE = re.compile(r"^(Bad|Good):\n\n((?:(?: {4}.*)?\n)+)", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Page:
    """What there is to know about a diagnostic.

    `title` is one line, `prose` Markdown, which may be empty. `bad` is a whole file with this problem and no other,
    `good` one without any; they are `.skill` text, or Turtle where the diagnostic is about that.
    """

    name: str
    title: str
    prose: str
    bad: str
    good: str


@cache
def pages() -> Mapping[str, Page]:
    """Return the pages of all diagnostics by name, in alphabetical order."""
    found = sorted((page for place in PLACES for page in _in(import_module(place))), key=lambda page: page.name)
    return MappingProxyType({page.name: page for page in found})


def _in(package: ModuleType) -> Iterator[Page]:
    for name in sorted(module.name for module in iter_modules(package.__path__) if module.name != "families"):
        yield from of_module(import_module(f"{package.__name__}.{name}"))


def of_module(module: ModuleType) -> list[Page]:
    """Return the pages in the docstring of a module."""
    text = f"{getdoc(module) or ''}\n"
    heads = list(_SECTION.finditer(text))
    if not heads:
        title, _, rest = text.partition("\n")
        return [_page(module.NAMES[0], title, rest)]
    ends = [*(head.start() for head in heads[1:]), len(text)]
    return [_page(head[1], head[2], text[head.end() : end]) for head, end in zip(heads, ends, strict=True)]


def _page(name: str, title: str, text: str) -> Page:
    """Return a page; KeyError where an example is missing."""
    examples = {kind: dedent(program).strip("\n") + "\n" for kind, program in _EXAMPLE.findall(text)}
    prose = _EXAMPLE.sub("", text).strip()
    return Page(name, title.rstrip("."), prose, examples["Bad"], examples["Good"])
