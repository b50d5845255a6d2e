"""Fixes that declare what is missing, so that the problem is gone."""

from __future__ import annotations

import pytest
from lsprotocol import types

from editor.desk import Desk
from editor.test_writing import edited, fixes
from skillc.services.check.library_checks import check_library
from skillc.services.library.files import find_library

pytestmark = pytest.mark.asyncio(loop_scope="session")

LACKING = """use skiros, rparts

skill Lay {
    in  x: Product
    in  y: Location
    in  z: Crate
    pre x lies y
    pre x.heat > 3 N
    pre x.dry == true
    noplan
}

impl down of Lay {
    do Lower(x, to: y, by: 3 N)
}
"""
DECLARED = {
    "declare the class `Crate`": "class Crate < Thing",
    "declare the relation `lies`": "relation lies(Product, Location)",
    "declare the property `heat`": "property heat(Product): Force",
    "declare the property `dry`": "property dry(Product): Bool",
    "declare the skill `Lower`": "skill Lower {\n    in x: Product\n    in to: Location\n    in by: Force\n",
    "add an implementation of `Lower` that does nothing": "impl by_stand_in of Lower {\n    run python",
}


async def test_what_is_missing_is_declared_one_after_the_other(desk: Desk) -> None:
    text, taken = LACKING, list[str]()
    desk.project()
    desk.open("lay.skill", text)
    for _ in DECLARED:
        rows = text.split("\n")
        found = await fixes(desk, "lay.skill", types.Range(types.Position(0, 0), types.Position(len(rows), 0)))
        action = next((each for each in found if each.title in DECLARED), None)
        if action is None:
            break
        taken.append(action.title)
        text = edited(desk, action.edit, {"lay.skill": text})["lay.skill"]
        assert DECLARED[action.title] in text
        desk.type("lay.skill", text)
    assert sorted(taken) == sorted(DECLARED)
    (desk.folder / "lay.skill").write_text(text)
    assert not [each for each in check_library(find_library(desk.folder), None) if each.severity == "error"]


async def test_a_name_of_another_vocabulary_is_not_declared(desk: Desk) -> None:
    desk.project()
    text = "use skiros\nprefix lab: <http://example.org/lab#>\nskill Go {\n    in x: lab:Crate\n    noplan\n}\n"
    desk.open("go.skill", text)
    found = await fixes(desk, "go.skill", types.Range(types.Position(0, 0), types.Position(6, 0)))
    assert not [each.title for each in found if each.title.startswith("declare the class")]
