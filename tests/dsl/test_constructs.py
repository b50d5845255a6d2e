"""Where something does not fit, the form of what was begun is shown."""

import pytest

from skillc_dsl.parsing.constructs import WRITTEN
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source


def test_each_form_begins_with_its_word() -> None:
    assert len(WRITTEN) > 30
    assert {kind: tokenize(Source("", form)).value[0].type for kind, form in WRITTEN.items()} == {
        kind: kind for kind in WRITTEN
    }


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("relation near\n", "`relation NAME(CLASS, CLASS)` or `relation NAME(NAME: CLASS, NAME: CLASS) = CONDITION`"),
        ("skill X {\n    infer a\n}\n", "`infer NAME: CLASS`"),
        ("impl x of X {\n    do seq {\n        wait\n    }\n}\n", "`wait 1 s` or `wait until C`"),
    ],
)
def test_the_form_is_shown(text: str, form: str) -> None:
    [problem] = parse(Source("own.skill", text)).diagnostics
    assert problem.help == f"write {form}"
