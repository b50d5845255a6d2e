"""Effects on all individuals that fulfil a condition: callers declare them, and know what they may have changed."""

from __future__ import annotations

import pytest

from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source

TEXT = """use sumo
class Tray < Object
class Cup < Object  disjoint Tray
class Plate < Object  disjoint Tray, Cup
relation lies(Object, Object)  functional
property isEmpty(Object): Bool
skill Move {
    in    tray: Tray
    post  forall c: Cup (c.isEmpty == true when c lies tray)
}
skill Fill {
    in    cup: Cup
    post  cup.isEmpty == false
}
skill Show {
    in    what: Object
    pre   what.isEmpty == false
}
skill Bring {
    in    tray: Tray
    in    cup: Cup
    in    plate: Plate
    pre   cup.isEmpty == false
    pre   plate.isEmpty == false
    DECLARED
    noplan
}
impl move of Move { run python "skillc.primitives:StandIn" }
skill Lift {
    in    cup: Cup
    post  not cup lies _
}
impl lift of Lift { run python "skillc.primitives:StandIn" }
impl fill of Fill { run python "skillc.primitives:StandIn" }
# allow no-effect: it is seen
impl show of Show { run python "skillc.primitives:StandIn" }
impl bring of Bring {
    do seq {
        BODY
    }
}
"""
SAME = "post spilled: forall k: Cup (k.isEmpty == true when k lies tray)"


@pytest.mark.parametrize(
    ("declared", "body", "reported"),
    [
        (SAME, "Move(tray)", []),
        (f"{SAME}\n    post not cup lies _", "Move(tray)\n        Lift(cup)", []),
        (f"{SAME}\n    post not cup lies _", "Lift(cup)\n        Move(tray)", ["post-not-established"]),
        (SAME, "try { wait 1 s }\n        Move(tray)", []),
        (SAME, "wait 1 s\n        apply spilled", []),
        (SAME, "wait 1 s", ["post-not-established"]),
        (SAME, "try { Move(tray) }", ["post-not-established"]),
        (SAME, "Move(tray)\n        Fill(cup)", ["post-not-established"]),
        (SAME, "sel { Move(tray) wait 1 s }", ["post-not-established"]),
        ("", "Move(tray)", ["undeclared-effect"]),
        (SAME, "par all { Move(tray) wait 1 s }", []),
        (SAME, "par all { Move(tray) Fill(cup) }", ["post-not-established"]),
        (SAME, "par any { Move(tray) wait 1 s }", ["post-not-established"]),
        (SAME.replace("when k lies tray", "when tray lies k"), "Move(tray)", ["post-not-established"]),
        (SAME, "Move(tray)\n        Show(what: plate)", []),
        (SAME, "Move(tray)\n        Show(what: cup)", ["child-precondition"]),
        (SAME, "Show(what: cup)\n        Move(tray)", []),
    ],
)
def test_a_caller(declared: str, body: str, reported: list[str]) -> None:
    text = TEXT.replace("DECLARED", declared).replace("BODY", body)
    found = compile([Source("a.skill", text)], load_vocabulary(), {}, "own").diagnostics
    names = [each.name for each in found if each.name not in ("no-effect", "unused-parameter", "unused-allow")]
    assert names == reported, [each.message for each in found]
