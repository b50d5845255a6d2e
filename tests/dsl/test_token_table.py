"""The table of tokens says what the grammar says."""

import re

import pytest
from examples import WHOLE

from skillc_dsl.comments import find_comments
from skillc_dsl.parsing.grammar import END, fixed_texts, list_following_terminals
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.source import Source
from skillc_dsl.token_table import (
    KEYWORDS,
    NAMES_ELSEWHERE,
    OPERATORS,
    PATTERNS,
    PUNCTUATION,
    TYPES,
    TokenKind,
    keyword_group,
    scan_tokens,
)
from skillc_dsl.units import DIMENSIONS

KINDS: dict[str, TokenKind] = {
    "STRING": "text",
    "IRI": "address",
    "LABEL": "label",
    "QNAME": "qualified name",
    "QUANTITY": "quantity",
    "NUMBER": "number",
    "NAME": "name",
}


def kind_of(terminal: str) -> TokenKind:
    if terminal in KINDS:
        return KINDS[terminal]
    text = fixed_texts()[terminal]
    return "name" if re.fullmatch(r"\w+", text) else "operator" if text in OPERATORS else "punctuation"


def test_the_keywords_are_those_of_the_grammar() -> None:
    listed = [word for group in KEYWORDS.values() for word in group]
    assert sorted(listed) == sorted(word for word in fixed_texts().values() if re.fullmatch(r"\w+", word))
    assert all(word in KEYWORDS[keyword_group(word) or "flag"] for word in listed)
    assert keyword_group("arm") is None


def test_the_marks_are_those_of_the_grammar() -> None:
    marks = {word for word in fixed_texts().values() if not re.fullmatch(r"\w+", word)}
    assert marks == {*OPERATORS, *PUNCTUATION}


def test_the_keywords_that_are_names_elsewhere_are_those_of_the_grammar() -> None:
    anywhere = (list_following_terminals("USE"), list_following_terminals("IMPL NAME OF NAME LBRACE LET NAME EQUAL"))
    relations = list_following_terminals("IMPL NAME OF NAME LBRACE PRE NAME") - list_following_terminals(
        "IMPL NAME OF NAME LBRACE"
    )
    keywords = {
        terminal for terminal, word in fixed_texts().items() if keyword_group(word) not in (None, "logic", "constant")
    }
    soft = {fixed_texts()[terminal] for terminal in keywords & (anywhere[0] | anywhere[1] | relations)}
    assert soft == NAMES_ELSEWHERE


def by_the_table(text: str) -> list[tuple[str, int, int]]:
    """What the table finds."""
    return [(kind, start, start + len(token)) for kind, start, token in scan_tokens(text)]


@pytest.mark.parametrize("kind", sorted({*PATTERNS} - {"comment", "documentation"}))
def test_the_patterns_are_those_of_the_grammar(kind: TokenKind) -> None:
    parsed = [t for t in tokenize(Source("", WHOLE)).value if t.type != END]
    lexed = [(kind_of(t.type), t.start_pos, t.end_pos) for t in parsed if kind_of(t.type) == kind]
    assert lexed
    assert [found for found in by_the_table(WHOLE) if found[0] == kind] == lexed


def test_the_patterns_of_comments_find_the_comments() -> None:
    notes = [(c.written.startswith("##"), len(c.written)) for c in find_comments(Source("", WHOLE))]
    found = [f for f in by_the_table(WHOLE) if f[0] in ("comment", "documentation")]
    assert [(kind == "documentation", end - start) for kind, start, end in found] == notes
    assert {True, False} == {documents for documents, _ in notes}


def test_the_types_hold_every_dimension() -> None:
    assert set(DIMENSIONS) <= set(TYPES)
