"""The tokens of the language in one table; tests compare the grammar and every highlighter with it."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator
from types import MappingProxyType
from typing import Literal, TypeAlias

from skillc_dsl.units import DIMENSIONS, UNITS

Group: TypeAlias = Literal["declaration", "member", "flag", "trait", "step", "property", "logic", "constant"]
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

KEYWORDS: MappingProxyType[Group, tuple[str, ...]] = MappingProxyType(
    {
        "declaration": (
            *("use", "prefix", "import", "class", "disjoint", "relation", "property", "function"),
            *("skill", "impl", "of", "task", "test"),
        ),
        "member": (
            *("in", "opt", "infer", "any", "out", "range", "refine", "pre", "hold", "post", "sensed", "duration"),
            *("uses", "shares", "pause", "anywhere", "between", "steps", "keep"),
            *("let", "prefer", "run", "python", "do", "scene", "goal", "verify"),
            *("start", "expect", "failure", "no", "plan"),
        ),
        "flag": ("scoped", "noplan", "fallback", "endless"),
        "trait": ("functional", "symmetric", "transitive", "inverse", "sub"),
        "step": (
            *("seq", "sel", "reactive", "par", "all", "race", "lead", "try", "invert", "once", "retry", "repeat"),
            *("timeout", "wait", "until", "if", "else", "while", "max", "for", "check", "apply", "with"),
        ),
        "property": ("never", "outside", "before", "after", "eventually"),
        "logic": ("implies", "or", "and", "not", "exists", "forall", "has", "is", "given"),
        "constant": ("true", "false", "_"),
    }
)
"""Every keyword, by what it is for. `any` is also a step's word, in `par any`."""

SINCE: MappingProxyType[str, int] = MappingProxyType(
    dict.fromkeys(("test", "start", "expect", "failure", "no", "plan"), 2),
)
"""The editions with which keywords came; the others are of the first. In an older edition a later one is a name."""

NAMES_ELSEWHERE: frozenset[str] = frozenset(
    (
        *("use", "prefix", "import", "disjoint", "of", "any", "range", "sensed", "duration", "prefer", "python"),
        *(
            "scene",
            "goal",
            "pause",
            "anywhere",
            "between",
            "steps",
            "keep",
            "test",
            "start",
            "expect",
            "failure",
            "no",
            "plan",
            *KEYWORDS["flag"],
            *KEYWORDS["trait"],
            *KEYWORDS["property"],
        ),
        *("all", "race", "lead", "invert", "once", "retry", "repeat", "timeout", "wait", "until", "max", "check"),
    )
)
"""Keywords that are legal names in places where no keyword fits."""

TYPES = (
    *(name for name in DIMENSIONS if name != "Number"),
    "Bool",
    "Int",
    "Number",
    "Text",
    "Pose",
    "Vector",
    "Direction",
)
"""The types that are not classes of an ontology."""

NAME = r"[^\W\d]\w*"
NUMBER = r"\d+(\.\d+)?([eE][+-]?\d+)?"
UNIT = "|".join(re.escape(unit) for unit in sorted(UNITS, key=lambda unit: (-len(unit), unit)))
OPERATORS = ("->", "..", "==", "!=", "<=", ">=", "=", "<", ">", "+", "-", "*", "/", ".")
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
