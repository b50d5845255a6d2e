"""The tokens of the language in one table; tests compare every highlighter with it."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Literal, TypeAlias

from skillc_dsl.descriptions.constructs import CONSTRUCTS, all_words
from skillc_dsl.descriptions.rows import Group
from skillc_dsl.units import DIMENSIONS, UNITS

TokenKind: TypeAlias = Literal[
    "documentation",
    "comment",
    "text",
    "address",
    "label",
    "qualified name",
    "quantity",
    "number",
    "name",
    "operator",
    "punctuation",
]

KEYWORDS: Mapping[Group, tuple[str, ...]] = MappingProxyType(
    {
        group: tuple(word.text for each in CONSTRUCTS if each.group == group for word in each.words)
        for group in dict.fromkeys(each.group for each in CONSTRUCTS)
    }
)
"""Every keyword, by what it is for. `any` and `never` also stand in other places."""

SINCE = MappingProxyType({word.text: word.since for word in all_words() if word.since > 1})
"""The editions with which keywords came; the others are of the first. In an older edition a later one is a name."""

NAMES_ELSEWHERE = frozenset(word.text for word in all_words() if word.name != "nowhere")
"""Keywords that are legal names in places where no keyword fits."""

TYPES = (
    *(name for name in DIMENSIONS if name != "Number"),
    "Bool",
    "Int",
    "Number",
    "Text",
    "Message",
    "Pose",
    "Vector",
    "Direction",
)
"""The types that are not classes of an ontology."""

NAME = r"[^\W\d]\w*"
NUMBER = r"\d+(\.\d+)?([eE][+-]?\d+)?"
UNIT = "|".join(re.escape(unit) for unit in sorted(UNITS, key=lambda unit: (-len(unit), unit)))
OPERATORS = ("->", "..", "==", "!=", "<=", ">=", "+=", "-=", ":=", "=", "<", ">", "+", "-", "*", "/", ".")
PUNCTUATION = ("{", "}", "(", ")", "[", "]", ",", ":")

PATTERNS: MappingProxyType[TokenKind, str] = MappingProxyType(
    {
        "documentation": r"##[^\n]*",
        "comment": r"#[^\n]*",
        "text": r'"[^"\n]*"',
        "address": r"<[^<>\s]*>",
        "label": rf"{NAME}:(?=\s|$)",
        "qualified name": rf"{NAME}:[^\W\d][\w-]*",
        "quantity": rf"{NUMBER}[ \t]*({UNIT})(?!\w)",
        "number": NUMBER,
        "name": NAME,
        "operator": "|".join(re.escape(operator) for operator in OPERATORS),
        "punctuation": "|".join(re.escape(mark) for mark in PUNCTUATION),
    }
)
"""Each kind of token with its regular expression; where several match, the first one wins. Keywords are names here."""


def list_later_words(edition: int) -> frozenset[str]:
    """Return the keywords that came after an edition."""
    return frozenset(word for word, since in SINCE.items() if since > edition)


def keyword_group(word: str) -> Group | None:
    """Return what a keyword is for, None for any other word."""
    return next((group for group, words in KEYWORDS.items() if word in words), None)


def scan_tokens(text: str) -> Iterator[tuple[TokenKind, int, str]]:
    """Yield the kind, position and text of each token, from left to right; other characters are left out."""
    for match in _table().finditer(text):
        yield _KINDS[match.lastgroup or ""], match.start(), match.group()


_KINDS: dict[str, TokenKind] = {f"k{number}": kind for number, kind in enumerate(PATTERNS)}


@functools.cache
def _table() -> re.Pattern[str]:
    """Return one expression with a group for each kind."""
    return re.compile("|".join(f"(?P<{key}>{PATTERNS[kind]})" for key, kind in _KINDS.items()))
