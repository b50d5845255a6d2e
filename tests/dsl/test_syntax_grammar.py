"""The grammar is strict LALR(1), and what is read off it holds."""

import re

import pytest
from lark import Lark
from lark.exceptions import GrammarError
from lark.parsers.lalr_analysis import LALR_Analyzer
from lark_peer import load_parser

from skillc_dsl.parsing.expectations import describe_terminals
from skillc_dsl.parsing.grammar import END, fixed_texts
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.parsing.tables import grammar_text
from skillc_dsl.source import Source
from skillc_dsl.units import UNITS


def analyse(grammar: str) -> None:
    """Raise GrammarError at any conflict, those included that lark would settle by itself."""
    parser = Lark(grammar, parser="lalr", lexer="basic").parser.parser
    LALR_Analyzer(parser.parser_conf, strict=True).compute_lalr()


@pytest.mark.slow
def test_the_grammar_has_no_conflict() -> None:
    analyse(grammar_text())


def test_a_conflict_would_show() -> None:
    ambiguous = grammar_text().replace("plain: NAME", "plain: _leading | NAME")
    assert ambiguous != grammar_text()
    with pytest.raises(GrammarError, match="Shift/Reduce conflict"):
        analyse(ambiguous)


@pytest.mark.parametrize("unit", UNITS)
def test_every_unit_makes_one_token(unit: str) -> None:
    for text in (f"8 {unit}", f"0.5{unit}", f"1e-3\t{unit}"):
        first, end = tokenize(Source("", text)).value
        assert (first.type, str(first), end.type) == ("QUANTITY", text, END)


def test_no_terminal_is_shown_by_its_name() -> None:
    shown = [
        describe_terminals([terminal.name])
        for terminal in load_parser().terminals
        if terminal.name not in ("BLANK", "COMMENT", "UNIT")
    ]
    assert len(shown) > 100
    marks = {f"`{text}`" for text in fixed_texts().values()}
    assert all(text in marks or not re.search(r"[A-Z]{2}", text.replace("IRI", "I")) for text in shown)
