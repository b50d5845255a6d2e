"""Skills without implementation, which symbolic cells run, change what their postconditions say."""

import pytest
from shipped import shelf, vocabulary

from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source

THINGS = """use skiros
class Keg < Product
property isTagged(Keg): Bool
skill Tag { in keg: Keg  post keg.isTagged == true }
skill Untag { in keg: Keg  post not keg.isTagged == true }
skill Body { in one: Keg  in two: Keg  PROMISES noplan }
impl x of Body { do BODY VERIFY }
"""
BOTH = "post one.isTagged == true post two.isTagged == true"


@pytest.mark.parametrize(
    ("body", "promises", "verify", "found"),
    [
        (
            "par all { Tag(keg: one) Untag(keg: two) }",
            "post one.isTagged == true post not two.isTagged == true",
            "",
            ["post-not-established"],
        ),
        (
            "par all { Tag(keg: one) Untag(keg: two) }",
            "pre not one == two post one.isTagged == true post not two.isTagged == true",
            "",
            [],
        ),
        ("seq { Tag(keg: one) Tag(keg: two) }", BOTH, "verify never one.isTagged == true", ["verify-violated"]),
        ("for k in [one, two] { Tag(keg: k) }", BOTH, "verify never one.isTagged == true", ["verify-violated"]),
        ("for k in [one, two] { Tag(keg: k) }", "post one.isTagged == true", "", ["undeclared-effect"]),
        (
            "for g in [one, two] { if not exists k: Keg (k.isTagged == true) { Tag(keg: g) } }",
            "",
            "",
            ["undeclared-effect"],
        ),
        (
            "seq { repeat 2 { Untag(keg: two) } }",
            "pre one.isTagged == true post one.isTagged == true post not two.isTagged == true",
            "",
            ["post-not-established"],
        ),
    ],
)
def test_what_they_change_is_followed(body: str, promises: str, verify: str, found: list[str]) -> None:
    text = THINGS.replace("PROMISES", promises).replace("BODY", body).replace("VERIFY", verify)
    told = compile([Source("a.skill", text)], vocabulary(), shelf(), "a").diagnostics
    assert [each.name for each in told if each.severity == "error"] == found
