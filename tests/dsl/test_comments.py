"""Comments are found where the grammar skips them, and nowhere else."""

import pytest
from examples import WHOLE
from hypothesis import given
from hypothesis import strategies as st

from skillc_dsl.comments import find_comments
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.source import Source


@pytest.mark.parametrize(
    ("line", "written"),
    [
        ("use skiros # why", "# why"),
        ("  # alone  ", "# alone"),
        ('scene "a#b.ttl"  # c', "# c"),
        ('scene "a#b.ttl', None),
        ("prefix lab: <http://example.org/lab#> # d", "# d"),
        ("pre a.b <c # e", "# e"),
        ("## doc # not another", "## doc # not another"),
    ],
)
def test_a_line(line: str, written: str | None) -> None:
    found = find_comments(Source("a.skill", f"\n{line}\n"))
    assert [c.written for c in found] == ([written] if written else [])
    for comment in found:
        assert (comment.span.line, comment.span.column) == (2, line.index(comment.written) + 1)


def test_documentation_stands_alone() -> None:
    doc, other, after = find_comments(Source("", "## What it is.\n# aside\nclass A < B  ## no documentation\n"))
    assert [doc.text, other.text, after.text] == ["What it is.", "aside", "no documentation"]
    assert [doc.alone, other.alone, after.alone] == [True, True, False]


@given(st.text(alphabet=st.sampled_from('ab#"<> \n:{\r')))
def test_what_is_no_token_and_no_comment_is_blank(text: str) -> None:
    source = Source("", text)
    found = {comment.span.line: comment.span for comment in find_comments(source)}
    for token in tokenize(source).value:
        if token and token.line in found:
            assert (token.end_column or 1) <= found[token.line].column


def test_the_examples_have_comments() -> None:
    assert len(find_comments(Source("", WHOLE))) == 12
