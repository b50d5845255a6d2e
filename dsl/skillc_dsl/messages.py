"""Texts with values: `"{force} is too much"`."""

from __future__ import annotations

import re

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_dsl.syntax.conditions import Member, Message, NameReference, Text
from skillc_dsl.syntax.names import Name

_PART = re.compile(
    r"(?P<brace>\{\{|\}\})|\{(?P<value>[^\W\d]\w*(?:\.[^\W\d]\w*)?)\}|(?P<text>[^{}]+)|(?P<other>\{[^{}]*\}?|\})"
)
"""The parts of a text with values."""


def read_message(written: Text) -> tuple[Message, tuple[Diagnostic, ...]]:
    """Return a text by its parts, and a problem for each brace that begins no value."""
    text, span = written.value, written.span
    parts: list[str | NameReference | Member] = []
    problems: list[Diagnostic] = []
    for found in _PART.finditer(text):
        column = span.column + 1 + found.start()
        place = Span(span.path, span.line, column, span.line, column + len(found.group()))
        match found.lastgroup:
            case "value":
                inner = Span(span.path, span.line, column + 1, span.line, place.end_column - 1)
                parts.append(_value(found["value"], inner))
            case "brace":
                parts.append(found.group()[0])
            case "text":
                parts.append(found.group())
            case _:
                message, help_ = f"`{found.group()}` stands for no value", _what_stands_there(found.group())
                problems.append(Diagnostic("syntax", place, message, help_))
    return Message(text, tuple(parts), span), tuple(problems)


def _value(text: str, span: Span) -> NameReference | Member:
    """Return the value that `name` or `name.member` stands for."""
    name, dot, member = text.partition(".")
    end = span.column + len(name)
    reference = NameReference(Name(name, span._replace(end_column=end)), span._replace(end_column=end))
    return Member(reference, Name(member, span._replace(column=end + 1)), span) if dot else reference


def _what_stands_there(part: str) -> str:
    """Return what to write instead of a part of a text that begins or ends with a brace."""
    path = re.match(r"\{\s*([^\W\d]\w*)\s*(\.\s*[^\W\d]\w*)?\s*([-+*/.:!(]|\})", part)
    if path is None:
        return f"write a name in braces, such as `{{force}}`, or `{part[0] * 2}` for a brace"
    name = f"{path[1]}{(path[2] or '').replace(' ', '')}"
    if path[3] in ":!":
        return f"write `{{{name}}}`: values are written with their units, and have no format"
    return f"write `{{{name}}}`: in braces stands a name, or a member of one; name what is computed with `let`"
