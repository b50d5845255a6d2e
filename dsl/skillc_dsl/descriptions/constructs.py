"""Declarations, conditions, and all constructs of the language together."""

from __future__ import annotations

import re
from collections.abc import Iterator

from skillc_dsl.descriptions.members import FLAGS, MEMBERS, OTHER_MEMBERS, PARAMETERS
from skillc_dsl.descriptions.nodes import DECORATORS, NODES
from skillc_dsl.descriptions.rows import Construct, Word, reserved, words

_DECLARATIONS = (
    Construct("declaration", words("use"), "use NAME, NAME"),
    Construct("declaration", words("prefix"), "prefix lab: <http://example.org/lab#>"),
    Construct("declaration", words("import"), 'import "NAME.skill"'),
    Construct("declaration", (*reserved("class"), *words("disjoint")), "class NAME < PARENT"),
    Construct("declaration", words("enum", since=2), "enum NAME { VALUE, VALUE }"),
    Construct(
        "declaration",
        reserved("relation"),
        "relation NAME(CLASS, CLASS)` or `relation NAME(NAME: CLASS, NAME: CLASS) = CONDITION",
    ),
    Construct("declaration", reserved("property"), "property NAME(CLASS): TYPE"),
    Construct(
        "declaration",
        reserved("function"),
        'function NAME(PARAMETER: TYPE) -> TYPE = python "MODULE:FUNCTION"',
    ),
    Construct("declaration", reserved("skill"), "skill NAME { .. }"),
    Construct("declaration", (*reserved("impl"), *words("of")), "impl NAME of SKILL { .. }"),
    Construct("declaration", reserved("task"), "task NAME { .. }"),
    Construct("declaration", words("test", since=2), "test NAME { .. }"),
)
_PARTS = (
    Construct("trait", words("functional symmetric transitive inverse sub")),
    Construct("property", (*words("never after", "leading"), *words("outside before eventually", "trailing"))),
    Construct("logic", reserved("implies or and not has is given")),
    Construct("logic", reserved("exists"), "exists NAME: CLASS (C)"),
    Construct("logic", reserved("forall"), "forall NAME: CLASS (C)"),
    Construct("constant", reserved("true false _")),
)
"""What stands within other constructs."""

CONSTRUCTS: tuple[Construct, ...] = (
    *_DECLARATIONS,
    *PARAMETERS,
    *MEMBERS,
    *OTHER_MEMBERS,
    *(Construct("flag", words(each.keyword, "trailing"), meaning=each.meaning) for each in FLAGS),
    *(Construct("step", each.words, each.written, each.meaning) for each in NODES),
    *(Construct("step", (each.word,), each.written, each.meaning) for each in DECORATORS),
    *_PARTS,
)
"""All constructs of the language. Each word is in one of them."""


def all_words() -> Iterator[Word]:
    """Yield each keyword with where it is also a legal name."""
    return (word for each in CONSTRUCTS for word in each.words)


def find_constructs(word: str) -> tuple[Construct, ...]:
    """Return the constructs with this keyword whose meaning is described."""
    return tuple(
        each
        for each in CONSTRUCTS
        if each.meaning and (word == first_word(each.written) or any(word == own.text for own in each.words))
    )


def list_forms() -> dict[str, str]:
    """Return the forms of what begins with each word, as far as there is help with it."""
    forms: dict[str, list[str]] = {}
    for each in CONSTRUCTS:
        if each.written:
            forms.setdefault(first_word(each.written), []).append(each.written)
    return {word.text: "` or `".join(forms[word.text]) for word in all_words() if word.text in forms}


def first_word(text: str) -> str:
    """Return the word with which a form begins."""
    return re.split(r"\W", text, maxsplit=1)[0]


def terminal(word: str) -> str:
    """Return the terminal of the grammar for a keyword."""
    return "UNDERSCORE" if word == "_" else word.upper()
