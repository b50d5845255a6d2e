"""What a form of another language is."""

from __future__ import annotations

import re
from typing import NamedTuple


class Form(NamedTuple):
    """A form, and what is written instead: `write` replaces it, or `advice` says it if that cannot be derived.

    Both are templates for the groups of the pattern. `where` is a terminal that fits where the fault is, if the form
    means something else elsewhere.
    """

    pattern: re.Pattern[str]
    write: str | None
    advice: str = ""
    where: str = ""


def leading(pattern: str, write: str | None, advice: str = "", where: str = "") -> Form:
    """Return a form that begins a declaration, a member or a step."""
    return Form(re.compile(rf"(?:^|(?<=[{{}}]))\s*(?P<form>{pattern})"), write, advice, where)


def inner(pattern: str, write: str | None, advice: str = "", where: str = "") -> Form:
    """Return a form that stands anywhere in a line."""
    return Form(re.compile(rf"(?P<form>{pattern})"), write, advice, where)
