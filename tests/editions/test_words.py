"""A keyword that came with a later edition is a plain name in libraries of older ones."""

from __future__ import annotations

from types import MappingProxyType

import pytest

from skillc_dsl import syntax as s
from skillc_dsl import token_table
from skillc_dsl.editions import EDITIONS
from skillc_dsl.formatting.formatter import format_source
from skillc_dsl.parsing.grammar import fixed_texts
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source
from skillc_dsl.token_table import SINCE

RELATION = """\
skill Wait {{
    in   one:   Product
    in   other: Product
    pre  one {0} other
    post other {0} one
}}
"""
TEST = """\
test waiting {
    scene  "cell.ttl"
    start  lab:A {0} lab:B
    expect failure "no"
    do     Wait(one: lab:A, other: lab:B)
}
"""


CALLED_OF = """\
skill Wait {
    in   of: Product
    in   to: Vector of Length
    pre  of.level == 3 and not of at of
    post of.level == 4
}

impl of of Wait {
    let more = of.level + of(of)
    do  Stay(of: of)
}
"""


def _errors(text: str, edition: int) -> list[str]:
    return [each.name for each in parse(Source("a.skill", text, edition=edition)).diagnostics]


@pytest.mark.parametrize("word", sorted({"start", "expect", "plan"}))
def test_a_later_word_is_a_name(word: str) -> None:
    text = RELATION.format(word)
    assert _errors(text, SINCE[word] - 1) == []
    assert set(_errors(text, SINCE[word])) == {"reserved-word"}


def test_a_word_that_a_row_gives_a_later_edition_is_a_name_before(monkeypatch: pytest.MonkeyPatch) -> None:
    text = RELATION.format("scoped")
    assert set(_errors(text, 1)) == {"reserved-word"}
    monkeypatch.setattr(token_table, "SINCE", MappingProxyType({**SINCE, "scoped": 2}))
    assert _errors(text, 1) == []
    assert set(_errors(text, 2)) == {"reserved-word"}
    assert _errors("skill Wait {\n    scoped\n}\n", 2) == []
    (problem,) = parse(Source("a.skill", "skill Wait {\n    scoped\n}\n", edition=1)).diagnostics
    assert problem.span.line == 2 and "from edition 2 on" in problem.help


def test_what_is_called_of_keeps_its_name_in_the_first_edition() -> None:
    assert _errors(CALLED_OF, 1) == []
    assert "reserved-word" in _errors(CALLED_OF, 2)


@pytest.mark.parametrize("edition", EDITIONS)
def test_a_declaration_that_begins_with_a_later_word_is_one_in_each_edition(edition: int) -> None:
    (declared,) = parse(Source("a.skill", TEST.replace("{0}", "contain"), edition=edition)).value.declarations
    assert isinstance(declared, s.TestDeclaration) and declared.name.text == "waiting"
    assert declared.starts and declared.expects


def test_formatting_keeps_what_an_older_edition_means() -> None:
    text = RELATION.format("start")
    assert format_source(Source("a.skill", text, edition=1)).value == text


def test_each_row_is_of_a_word_and_of_an_edition() -> None:
    assert set(SINCE) <= set(fixed_texts().values())
    assert set(SINCE.values()) <= set(EDITIONS[1:])
