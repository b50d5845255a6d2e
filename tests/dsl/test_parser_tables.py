"""Our parser does what that of lark does, and tables from the cache are as fresh ones."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from examples import WHOLE
from hypothesis import example, given
from lark.exceptions import LarkError
from lark_peer import convert, describe, load_parser
from programs import programs

from skillc_dsl.diagnostics import Outcome
from skillc_dsl.parsing import tables
from skillc_dsl.parsing.automaton import MisfitError, parse_tree
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.parsing.parser import build_directly, parse_with_problems
from skillc_dsl.parsing.tables import grammar_text, load_tables, read_built_tables, read_or_make_tables
from skillc_dsl.parsing.tokens import Tree
from skillc_dsl.source import Source

SHIPPED = sorted((Path(__file__).parents[2] / "skills_src/skillc_skills").glob("*/*.skill"))


def parse_as_lark(text: str) -> Tree | None:
    """Return the tree of a text without mistakes, None for any other; it is that of lark."""
    lexed = tokenize(Source("", text))
    try:
        theirs = convert(load_parser().parse(text))
    except LarkError:
        theirs = None
    try:
        ours = None if lexed.diagnostics else parse_tree(lexed.value)
    except MisfitError:
        ours = None
    assert ours == theirs
    assert ours is None or describe(ours) == describe(theirs)  # type: ignore[arg-type]
    return ours


def parse_in_both_ways(text: str) -> bool:
    """Whether a text is parsed in one pass, with the same result as by the parser that reports mistakes."""
    source = Source("a.skill", text)
    lexed = tokenize(source)
    direct = None if lexed.diagnostics else build_directly(lexed.value, source)
    whole = parse_with_problems(source, lexed, None)
    assert whole.diagnostics or direct is not None
    assert direct is None or whole == Outcome(direct)
    return direct is not None


def test_a_file_with_everything_is_parsed_as_by_lark() -> None:
    assert parse_as_lark(WHOLE) is not None


@given(programs())
@example("enum Use { use , arm ,\nenum }")
def test_random_programs_are_parsed_as_by_lark(text: str) -> None:
    assert parse_as_lark(text) is not None
    parse_in_both_ways(text)


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_shipped_files_are_parsed_as_by_lark_also_with_mistakes(path: Path) -> None:
    text, chance = path.read_text(encoding="utf-8"), random.Random(path.stem)
    assert parse_as_lark(text) is not None
    assert parse_in_both_ways(text)
    for _ in range(5):
        at = chance.randrange(len(text))
        mistaken = text[:at] + text[at + chance.randrange(1, 9) :]
        parse_as_lark(mistaken)
        parse_in_both_ways(mistaken)


@pytest.mark.slow
def test_tables_are_built_for_one_grammar(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    built, grammar = tmp_path / "tables.msgpack", grammar_text()
    assert read_built_tables(grammar, built) is None
    monkeypatch.setattr(tables, "BUILT", built)
    tables.build_tables()
    found = read_built_tables(grammar, built)
    assert found is not None and len(found.states) == len(load_tables().states) > 100
    assert read_built_tables(grammar.replace("skill", "skull"), built) is None


@pytest.mark.slow
def test_tables_are_kept_and_damaged_ones_are_made_again(tmp_path: Path) -> None:
    first = read_or_make_tables(grammar_text(), tmp_path / "new")
    (kept,) = (tmp_path / "new").iterdir()
    assert read_or_make_tables(grammar_text(), tmp_path / "new") == first
    kept.write_bytes(kept.read_bytes()[:-5])
    again = read_or_make_tables(grammar_text(), tmp_path / "new")
    assert (len(again.states), again.rules) == (len(first.states), first.rules)
    assert read_or_make_tables(grammar_text(), tmp_path / "new") == again


def test_a_folder_that_cannot_be_made_is_no_obstacle(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    assert read_or_make_tables(grammar_text(), tmp_path / "file").states
