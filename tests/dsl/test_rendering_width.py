"""Diagnostics on pages of a given width: wrapping, long lines, tabs and wide characters."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.rendering import full
from skillc_dsl.rendering.columns import CUT, clip_line, count_cells, lay_out
from skillc_dsl.source import Source, Span

LONG = "many words of explanation that do not fit on one line of a narrow terminal, so that they are wrapped"
SOURCE = Source("a.skill", f"skill Pick {{\n\tin arm:Arm   # {'x' * 150} far\n\n\n\tpost done\n}}\n")
PROBLEM = Diagnostic(
    "missing-space-after-colon",
    Span("a.skill", 2, 5, 2, 9),
    LONG,
    LONG,
    labels=(Label(Span("a.skill", 1, 7, 1, 11), LONG), Label(Span("a.skill", 2, 168, 2, 171), LONG)),
    fix=Fix(Span("a.skill", 2, 9, 2, 9), " ", f"do it: {LONG}"),
)
CHARACTERS = st.sampled_from("abc \té你好🙂\u0301\x1b")


@pytest.mark.parametrize("width", [40, 60, 80, 120])
def test_nothing_is_wider_than_the_page(width: int) -> None:
    rows = full.render([PROBLEM], {"a.skill": SOURCE}, width=width).splitlines()
    assert len(rows) > 10
    assert max(count_cells(row) for row in rows) <= width


@pytest.mark.parametrize("width", [40, 60, 120, None])
def test_every_word_is_said_at_every_width(width: int | None) -> None:
    said = full.render([PROBLEM], {"a.skill": SOURCE}, width=width)
    words = [word for row in said.splitlines() for word in row.replace("|", " ").split()]
    assert all(words.count(word) >= 5 for word in set(LONG.split()))


def test_wide_characters_count_twice_and_tabs_go_to_the_next_stop() -> None:
    source = Source("a.skill", '\tin "你é🙂" Prodct\n')
    problem = Diagnostic("unknown-class", Span("a.skill", 1, 11, 1, 17), "no")
    *_, line, carets = full.render([problem], {"a.skill": source}).splitlines()
    assert line == '1 |     in "你é🙂" Prodct'
    assert count_cells(line[: line.index("Prodct")]) == carets.index("^")
    assert carets.endswith(" ^^^^^^")


def test_lines_between_marks_are_left_out_but_a_single_one_is_shown() -> None:
    far = Diagnostic("far", Span("a.skill", 2, 2, 2, 4), "", labels=(Label(Span("a.skill", 5, 2, 5, 6), "this"),))
    near = Diagnostic("near", Span("a.skill", 5, 2, 5, 6), "", labels=(Label(Span("a.skill", 3, 1, 3, 1), "that"),))
    assert "\n...\n5 |" in full.render([far], {"a.skill": SOURCE})
    assert "\n3 |\n  | - that\n4 |\n5 |     post done\n" in full.render([near], {"a.skill": SOURCE})


def test_a_fix_elsewhere_is_shown_as_it_will_stand() -> None:
    fix = Fix(Span("a.skill", 5, 11, 5, 11), "\n\tpost gone", "add it")
    shown = full.render([Diagnostic("two", Span("a.skill", 1, 1, 1, 6), "", fix=fix)], {"a.skill": SOURCE})
    assert shown.endswith("  = fix: add it (--fix does it)\n+ |     post gone\n")


def test_a_fix_that_is_a_guess_is_not_promised() -> None:
    fix = Fix(Span("a.skill", 1, 1, 1, 6), "scene", "write `scene`", safe=False)
    shown = full.render([Diagnostic("two", Span("a.skill", 1, 1, 1, 6), "", fix=fix)], {"a.skill": SOURCE})
    assert shown.endswith("  = fix: write `scene`\n")


@given(st.text(CHARACTERS, max_size=60), st.integers(0, 60), st.integers(1, 20), st.integers(24, 60))
def test_a_window_shows_the_place_in_the_width_given(text: str, start: int, length: int, width: int) -> None:
    line = lay_out(text)
    start = min(start, line.edges[-1])
    shown = clip_line(line, start, start + length, width)
    assert count_cells(shown.text) <= width
    assert shown.shift <= start <= shown.shift + width
    assert shown.text.startswith(CUT) == (shown.shift > 0)
    if line.edges[-1] <= width:
        assert shown.text == "".join(line.pieces)


@given(st.text(CHARACTERS, max_size=40))
def test_edges_are_where_the_terminal_puts_characters(text: str) -> None:
    line = lay_out(text)
    assert [line.edge(column) for column in range(1, len(text) + 1)] == [
        count_cells("".join(line.pieces[:index])) for index in range(len(text))
    ]


def test_help_that_the_fix_repeats_is_said_once() -> None:
    fix = Fix(Span("a.skill", 1, 1, 1, 6), "scene", "write `scene`")
    shown, other = (
        full.render([Diagnostic("two", Span("a.skill", 1, 1, 1, 6), "", help_, fix=fix)], {"a.skill": SOURCE})
        for help_ in ("write `scene`", "write `scene` or `goal`")
    )
    assert (shown.count("write `scene`"), other.count("write `scene`")) == (1, 2)
