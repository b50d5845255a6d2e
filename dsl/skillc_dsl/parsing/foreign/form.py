"""What a form of another language is."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple


class Form(NamedTuple):
    """A form, and what is written instead: `write` replaces it, or `advice` says it if that cannot be derived.

    Both are templates for the groups of the pattern. `where` is a terminal that fits where the fault is, if the form
    means something else elsewhere.
    """

    pattern: str
    write: str | None
    advice: str = ""
    where: str = ""

    def find_in(self, line: str) -> Iterator[re.Match[str]]:
        """Yield the matches in a line; the pattern is compiled for the first one, since there are many forms."""
        return _compile(self.pattern).finditer(line)


_compile = cache(re.compile)


def leading(pattern: str, write: str | None, advice: str = "", where: str = "") -> Form:
    """Return a form that begins a declaration, a member or a step."""
    return Form(rf"(?:^|(?<=[{{}}]))\s*(?P<form>{pattern})", write, advice, where)


def inner(pattern: str, write: str | None, advice: str = "", where: str = "") -> Form:
    """Return a form that stands anywhere in a line."""
    return Form(rf"(?P<form>{pattern})", write, advice, where)
