"""Declarations, conditions, and all constructs of the language together."""

from __future__ import annotations

import re
from collections.abc import Iterator

from skillc_dsl.descriptions.members import FLAGS, MEMBERS, OTHER_MEMBERS, PARAMETERS
from skillc_dsl.descriptions.nodes import DECORATORS, NODES
from skillc_dsl.descriptions.rows import Construct, Word, reserved, words

_DECLARATIONS = (
    Construct("declaration", words("use"), "use NAME, NAME", "vocabularies whose terms may be written without prefix"),
    Construct(
        "declaration",
        words("prefix"),
        "prefix lab: <http://example.org/lab#>",
        "a prefix of qualified names, such as `lab:Table-1`",
    ),
    Construct(
        "declaration",
        words("import"),
        'import "NAME.skill"',
        "makes the declarations of another file visible: of this library, of `std/`, or, with its folder, of another "
        "library",
    ),
    Construct(
        "declaration",
        (*reserved("class"), *words("disjoint")),
        "class NAME < PARENT",
        "a class of individuals, below its parents; no individual is also of a class after `disjoint`",
    ),
    Construct(
        "declaration",
        words("enum", since=2),
        "enum NAME { VALUE, VALUE }",
        "a class with these individuals and no others; a bare value is looked up in the enumeration that is expected",
    ),
    Construct(
        "declaration",
        reserved("relation"),
        "relation NAME(CLASS, CLASS)` or `relation NAME(NAME: CLASS, NAME: CLASS) = CONDITION",
        "a relation between individuals of two classes; with a condition, it is defined by it",
    ),
    Construct(
        "declaration",
        reserved("property"),
        "property NAME(CLASS): TYPE range VALUE .. VALUE",
        "a value that individuals of a class can have",
    ),
    Construct(
        "declaration",
        reserved("function"),
        'function NAME(PARAMETER: TYPE) -> TYPE = python "MODULE:FUNCTION"',
        "a function written in Python, which gets the world state and then its arguments",
    ),
    Construct("declaration", reserved("skill"), "skill NAME { .. }", "what can be done: parameters and conditions"),
    Construct(
        "declaration",
        (*reserved("impl"), *words("of", "leading")),
        "impl NAME of SKILL { .. }",
        "how a skill is done: a body, or a class of Python",
    ),
    Construct(
        "declaration",
        reserved("task"),
        "task NAME { .. }",
        "what is to be done in a scene: a goal, which is planned, or a body, which is executed",
    ),
    Construct(
        "declaration",
        words("test", since=2),
        "test NAME { .. }",
        "says what comes of a body or a goal; `skillc test` runs it without bodies",
    ),
)
_PARTS = (
    Construct("trait", words("functional"), meaning="at most one value: asserting another one retracts the former"),
    Construct("trait", words("symmetric"), meaning="the relation holds in both directions"),
    Construct("trait", words("transitive"), meaning="what holds from one to the next holds from the first to the last"),
    Construct("trait", words("inverse"), meaning="the relation after it holds the other way round"),
    Construct("trait", words("sub"), meaning="the relation implies the one after it"),
    Construct("property", words("never", "leading"), meaning="what follows happens in no execution"),
    Construct("property", words("after", "leading"), meaning="states what comes once the event after it has happened"),
    Construct("property", words("outside", "trailing"), meaning="unless the skill after it is active"),
    Construct("property", words("before", "trailing"), meaning="the event after it comes only after the first one"),
    Construct("property", words("eventually", "trailing"), meaning="no run succeeds unless the event after it comes"),
    Construct("logic", reserved("implies"), meaning="the second condition holds, or the first one does not"),
    Construct("logic", reserved("or"), meaning="one of the conditions holds, or both"),
    Construct("logic", reserved("and"), meaning="both conditions hold"),
    Construct("logic", reserved("not"), meaning="the condition after it does not hold"),
    Construct("logic", reserved("has"), meaning="the property after it has a value"),
    Construct("logic", reserved("is"), meaning="the individual is of the class after it or of a subclass"),
    Construct("logic", reserved("given"), meaning="the optional parameter after it was passed"),
    Construct(
        "logic", reserved("exists"), "exists NAME: CLASS (C)", "the condition holds for some individual of the class"
    ),
    Construct(
        "logic", reserved("forall"), "forall NAME: CLASS (C)", "the condition holds for every individual of the class"
    ),
    Construct("constant", reserved("true false"), meaning="a value of the type `Bool`"),
    Construct("constant", reserved("_"), meaning="any individual"),
)
"""What stands within other constructs."""

_SMALL = re.compile(r"(?<![\w\"])[a-z]+(?![\w\"])")
_BETWEEN_FORMS = re.compile(r"`[^`]*`")
_SHARED = re.compile(r"`par (\w+)`")
"""What may stand after `par`; the row of a parameter has `any` too."""

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


def find_construct(word: str, line: str) -> Construct | None:
    """Return the construct that a keyword belongs to where it stands: the one of which most is on its line."""
    there = frozenset(re.findall(r"\w+", line))

    def fit(construct: Construct) -> tuple[bool, int, int]:
        written = _words_of(construct)
        begins = (first_word(construct.written) or construct.words[0].text) in there
        return begins, len(written & there), -len(written)

    return max((each for each in CONSTRUCTS if each.meaning and word in _words_of(each)), key=fit, default=None)


def _words_of(construct: Construct) -> frozenset[str]:
    """Return the keywords of a construct, with those that others have too."""
    shared = _SHARED.findall(construct.meaning) if construct.written else ()
    forms = _BETWEEN_FORMS.sub(" ", construct.written)
    return frozenset((*(each.text for each in construct.words), *_SMALL.findall(forms), *shared))


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
