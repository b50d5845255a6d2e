"""Edits of a text: several fixes at once."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillc_dsl.diagnostics import Fix
from skillc_dsl.edits import apply_fixes, drop_overlapping
from skillc_dsl.source import Span

TEXT = "one two\nthree\n"


def fix(line: int, column: int, end_line: int, end_column: int, text: str) -> Fix:
    return Fix(Span("a", line, column, end_line, end_column), text, "")


def test_fixes_are_applied_where_they_stand_in_the_old_text() -> None:
    fixes = [fix(1, 1, 1, 4, "ONE!"), fix(1, 5, 2, 1, ""), fix(3, 1, 3, 1, "end")]
    assert apply_fixes(TEXT, fixes) == "ONE! three\nend"


@pytest.mark.parametrize("line", [0, 4, 9])
def test_a_place_that_is_not_in_the_text_is_refused(line: int) -> None:
    with pytest.raises(ValueError, match="there is no"):
        apply_fixes(TEXT, [fix(line, 1, line, 1, "x")])


def test_of_fixes_that_touch_the_first_is_kept() -> None:
    first, touching, apart_ = fix(1, 1, 1, 4, "a"), fix(1, 4, 1, 5, "b"), fix(1, 5, 1, 6, "c")
    assert drop_overlapping([apart_, touching, first, first]) == (first, apart_)


@given(st.lists(st.tuples(st.integers(0, 30), st.integers(0, 4), st.text("xy\n", max_size=3)), max_size=6))
def test_fixes_together_are_fixes_one_by_one_from_the_end(edits: list[tuple[int, int, str]]) -> None:
    text = "abcde\n" * 6
    fixes = drop_overlapping(
        fix(start // 6 + 1, start % 6 + 1, (start + n) // 6 + 1, (start + n) % 6 + 1, new) for start, n, new in edits
    )
    one_by_one = text
    for each in reversed(fixes):
        one_by_one = apply_fixes(one_by_one, [each])
    assert apply_fixes(text, fixes) == one_by_one
