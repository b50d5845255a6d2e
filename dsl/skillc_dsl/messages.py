"""Texts with values: `"{force} is too much"`."""

from __future__ import annotations

import re

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_dsl.syntax.conditions import Message, NameReference, Text
from skillc_dsl.syntax.names import Name

_PART = re.compile(r"(?P<brace>\{\{|\}\})|\{(?P<name>[^\W\d]\w*)\}|(?P<text>[^{}]+)|(?P<other>\{[^{}]*\}?|\})")
"""The parts of a text with values."""


def read_message(written: Text) -> tuple[Message, tuple[Diagnostic, ...]]:
    """Return a text by its parts, and a problem for each brace that begins no name."""
    text, span = written.value, written.span
    parts: list[str | NameReference] = []
    problems: list[Diagnostic] = []
    for found in _PART.finditer(text):
        column = span.column + 1 + found.start()
        place = Span(span.path, span.line, column, span.line, column + len(found.group()))
        match found.lastgroup:
            case "name":
                inner = Span(span.path, span.line, column + 1, span.line, place.end_column - 1)
                parts.append(NameReference(Name(found["name"], inner), inner))
            case "brace":
                parts.append(found.group()[0])
            case "text":
                parts.append(found.group())
            case _:
                message, help_ = f"`{found.group()}` stands for no value", _name_in_braces(found.group())
                problems.append(Diagnostic("syntax", place, message, help_))
    return Message(text, tuple(parts), span), tuple(problems)


def _name_in_braces(part: str) -> str:
    """Return what to write instead of a part of a text that begins or ends with a brace."""
    path = re.match(r"\{\s*([^\W\d]\w*)\s*\.", part)
    if path is not None:
        return f"write `{{{path[1]}}}`: only a name stands in braces"
    return f"write a name in braces, such as `{{force}}`, or `{part[0] * 2}` for a brace"
