"""Pygments shows skill files in the colours of their tokens."""

import pytest
from examples import WHOLE
from pygments.token import Comment, Error, Keyword, Name, Number, Operator, String

from skillc_dsl.highlighting import SkillLexer


@pytest.mark.parametrize(
    ("text", "piece", "kind"),
    [
        ("skill Pick {", "skill", Keyword.Declaration),
        ("skill Pick {", "Pick", Name),
        ("in arm: Force", "in", Keyword),
        ("in arm: Force", "arm:", Name.Label),
        ("in arm: Force", "Force", Keyword.Type),
        ("a.range == 5 N/m", "range", Name),
        ("a.range == 5 N/m", "5 N/m", Number),
        ("pre not a has b", "not", Operator.Word),
        ("a == true", "true", Keyword.Constant),
        ("pause between steps keep 2 s", "steps", Keyword),
        ("arm.steps == 2", "steps", Name),
        ("## What it is.", "## What it is.", String.Doc),
        ("a # why", "# why", Comment.Single),
        ('scene "a # b.ttl"', '"a # b.ttl"', String.Double),
    ],
)
def test_a_token(text: str, piece: str, kind: object) -> None:
    assert (kind, piece) in SkillLexer().get_tokens(text)


def test_nothing_is_lost_and_nothing_is_wrong() -> None:
    pieces = list(SkillLexer(stripnl=False).get_tokens(f"{WHOLE}; ~"))
    assert "".join(text for _, text in pieces) == f"{WHOLE}; ~\n"
    assert len(pieces) > 500
    assert Error not in {kind for kind, _ in pieces}
