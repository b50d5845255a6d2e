"""Proofs look into the definitions of relations: what follows from a step, and what a step may end."""

from __future__ import annotations

import pytest

from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source

TEXT = """use skiros, sumo
class Carrier < Container
class Cup < Object  disjoint Location
class Hall < Location  disjoint Carrier
relation standsIn(x: Object, l: Location) = l contain x or exists c: Carrier (l contain c and c contain x)
relation isIn(x: Object, l: Location) = l contain x or exists m: Location (l contain m and x isIn m)
skill Move {
    in    tray: Carrier
    in    to:   Hall
    infer from: Hall
    pre   from contain tray
    post  to contain tray
    post  not from contain tray
}
skill Serve {
    in    cup: Cup
    in    to:  Hall
    pre   NEEDED
    post  not to contain cup
}
skill Bring {
    in    cup:  Cup
    in    tray: Carrier
    in    to:   Hall
    infer from: Hall
    pre   from contain tray
    pre   KNOWN
    pre   not to == from
    post  to contain tray
    post  not from contain tray
    post  not to contain cup
    noplan
}
impl move of Move { run python "skillc.primitives:StandIn" }
impl serve of Serve { run python "skillc.primitives:StandIn" }
impl bring of Bring {
    do seq {
        Move(tray, to, from)
        Serve(cup, to)
    }
}
"""


@pytest.mark.parametrize(
    ("known", "needed", "reported"),
    [
        ("tray contain cup", "cup standsIn to", []),
        ("tray contain cup", "cup isIn to", []),
        ("tray contain cup", "exists l: Hall (cup isIn l)", []),
        ("cup isIn tray", "cup isIn to", ["child-precondition"]),
        ("not from contain cup", "not cup standsIn to", ["child-precondition"]),
        ("cup standsIn to", "cup standsIn to", ["child-precondition"]),
        ("cup isIn to", "cup isIn to", ["child-precondition"]),
    ],
)
def test_what_a_step_changes_of_it_is_known(known: str, needed: str, reported: list[str]) -> None:
    text = TEXT.replace("NEEDED", needed).replace("KNOWN", known)
    found = compile([Source("a.skill", text)], load_vocabulary(), {}, "own").diagnostics
    assert [each.name for each in found] == reported, [each.message for each in found]
