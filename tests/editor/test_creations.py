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

enum Grade { Good, Bad }
property grade(Product): Grade

skill Turn {
    in x: Product
    noplan
}

impl round of Turn { run python "skillc.primitives:StandIn" }

skill Lay {
    in  x: Product
    in  y: Location
    in  z: Crate
    pre x lies y
    pre x.heat > 3 N
    pre x.dry == true
    pre x.grade == Ugly
    noplan
}

impl down of Lay {
    do seq {
        Turn(x, onto: y)
        Lower(x, to: y, by: 3 N)
    }
}
"""
DECLARED = {
    "add `Ugly` to `Grade`": "enum Grade { Good, Bad, Ugly }",
    "add the parameter `onto` to `Turn`": "    in x: Product\n    in onto: Location\n",
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


STACK = """use skiros
prefix lab: <http://example.org/lab#>
class Crate < Product
relation stackedOn(Crate, Crate)
property filling(Crate): Number
skill Stack {
    in   crate: Crate
    in   onto:  Crate
    post crate stackedOn onto
}
task go {
    goal GOAL
}
test stacks {
    do Stack(crate: CRATE, onto: lab:Crate-1)
}
"""
YARD = """@prefix lab: <http://example.org/lab#> .
@prefix own: <http://example.org/yard#> .

lab:Crate-1 a own:Crate ; own:filling 0.0 .  # the first
"""


@pytest.mark.parametrize(
    ("goal", "crate", "unknown"),
    [
        ("lab:Crate-1 is Crate", "lab:Box-7", "lab:Box-7"),
        ("lab:Box-7 stackedOn lab:Crate-1", "lab:Crate-1", "lab:Box-7 st"),
        ("lab:Crate-1 stackedOn lab:Box-7", "lab:Crate-1", "lab:Box-7"),
        ("lab:Box-7.filling == 0", "lab:Crate-1", "lab:Box-7"),
        ("lab:Box-7 is Crate", "lab:Crate-1", "lab:Box-7"),
        ("lab:Box-7 has filling", "lab:Crate-1", "lab:Box-7"),
    ],
)
async def test_an_individual_is_stated_in_the_scene(desk: Desk, goal: str, crate: str, unknown: str) -> None:
    manifest = 'name = "yard"\nedition = 2\nnamespace = "http://example.org/yard#"\nscene = "yard.ttl"\n'
    (desk.folder / "skillc.toml").write_text(f'{manifest}[tool.run]\nbackend = "symbolic"\n')
    (desk.folder / "yard.ttl").write_text(YARD)
    text = STACK.replace("GOAL", goal).replace("CRATE", crate)
    (desk.folder / "stack.skill").write_text(text)
    desk.open("stack.skill", text)
    before = text[: text.index(unknown)]
    at = types.Position(before.count("\n"), len(before.rpartition("\n")[2]))
    found = await fixes(desk, "stack.skill", types.Range(at, at))
    (action,) = (each for each in found if each.title == "state `lab:Box-7 a own:Crate` in yard.ttl")
    stated = edited(desk, action.edit, {"yard.ttl": YARD})["yard.ttl"]
    assert stated == f"{YARD}\nlab:Box-7 a own:Crate .\n"
    (desk.folder / "yard.ttl").write_text(stated)
    assert "unknown-individual" not in {each.name for each in check_library(find_library(desk.folder), None)}
