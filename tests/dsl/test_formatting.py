"""Formatting keeps meaning and comments, is done once and for all, and looks as written here."""

import os
import re
from pathlib import Path

import pytest
from examples import EVERYTHING
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from programs import programs

from skillc_dsl.comments import find_comments
from skillc_dsl.formatting.formatter import equal_modulo_layout, format_source
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source

ROOT = Path(__file__).parents[2]
LOOKS = sorted((ROOT / "tests" / "cases" / "formatting").glob("*.skill"))
SHIPPED = sorted((ROOT / "skills_src").rglob("*.skill"))
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
MANY = settings(
    max_examples=int(os.environ.get("SKILLC_EXAMPLES", "20")),
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
)


def layout(text: str) -> str:
    outcome = format_source(Source("a.skill", text))
    assert outcome.diagnostics == ()
    return outcome.value


@MANY
@given(programs())
def test_a_program_keeps_its_meaning_and_its_comments_and_is_formatted_once(text: str) -> None:
    source = Source("a.skill", text)
    assume(parse(source).ok)
    once = layout(text)
    assert equal_modulo_layout(source, Source("a.skill", once))
    assert layout(once) == once
    assert not re.search(r"[ \t]\n|\n\n\n|^\n|\n\n$", once)


@MANY
@given(st.data())
def test_the_lines_do_not_depend_on_the_blanks(data: st.DataObject) -> None:
    """However the tokens of a text stand, they come out alike, but for blank lines and for blocks of one line."""
    tokens = [str(token) for token in tokenize(Source("", EVERYTHING)).value]
    blanks = data.draw(st.lists(st.sampled_from([" ", "\n", "\t \n"]), min_size=len(tokens), max_size=len(tokens)))
    assert layout("".join(map("".join, zip(tokens, blanks, strict=True)))).split() == layout("\n".join(tokens)).split()


@MANY
@given(
    st.lists(st.tuples(st.integers(0, 1000), st.sampled_from(["\n# own\n", "\n\n## doc\n", " # after\n"])), max_size=9)
)
def test_a_comment_may_stand_anywhere(places: list[tuple[int, str]]) -> None:
    starts = [token.start_pos or 0 for token in tokenize(Source("", EVERYTHING)).value]
    text = EVERYTHING
    for start, comment in sorted(((starts[n % len(starts)], comment) for n, comment in places), reverse=True):
        text = text[:start] + comment + text[start:]
    once = layout(text)
    assert [c.written for c in find_comments(Source("", once))] == [c.written for c in find_comments(Source("", text))]
    assert layout(once) == once


@pytest.mark.parametrize("path", LOOKS, ids=lambda path: path.stem)
def test_a_look(path: Path) -> None:
    """What stands above the line of `=` comes out as what stands below it."""
    written, wanted = path.read_text(encoding="utf-8").split(f"# {'=' * 20}\n")
    assert layout(written) == wanted
    assert layout(wanted) == wanted


def test_there_are_looks() -> None:
    assert len(LOOKS) >= 5


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_shipped_files_are_formatted(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert layout(text) == text


def test_examples_in_the_documentation_are_formatted() -> None:
    examples = [
        text for page in PAGES for text in re.findall(r"^```skill\n(.*?)^```", page.read_text("utf-8"), re.M | re.S)
    ]
    assert len(examples) >= 6
    for text in examples:
        assert layout(text) == text


@pytest.mark.parametrize("text", ["", "\n", "  \n\n\t", "# nothing", "\r\n"])
def test_next_to_nothing(text: str) -> None:
    assert layout(text) == (f"{text.strip()}\n" if text.strip() else "")


def test_a_file_with_errors_stays_as_it_is() -> None:
    text = "skill  A {\n  in arm ArmDevice\n}\n"
    outcome = format_source(Source("a.skill", text))
    assert (outcome.value, outcome.ok) == (text, False)
    assert [d.name for d in outcome.diagnostics] == ["syntax"]


def test_what_nests_too_deeply_stays_as_it_is() -> None:
    text = f"impl x of Y {{\npre {'(' * 5000}a{')' * 5000}\n}}\n"
    outcome = format_source(Source("a.skill", text))
    assert (outcome.value, [d.name for d in outcome.diagnostics]) == (text, ["nesting-too-deep"])
