"""What scenes say wrongly of areas, fixtures, people and arms is told when they are read or before anything moves."""

from __future__ import annotations

import pytest
from cells import vocabulary, world

from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.scene.documents import Document, SceneError
from skillc_runtime.scene.load import load_documents, sheet_documents
from skillc_runtime.world.state.data_sheet import DataSheet, SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import SKILLC

READ = [
    ("iiwa_outlet", "skillc:margin 0.01", "skillc:margin -0.01", "it is at least 0"),
    ("iiwa_outlet", '"label" ; skiros:BaseFrameId "table"', '"label"', "does not say where lab:Label-1 is"),
    ("iiwa_outlet", "hasHole lab:Outlet-1, lab:Label-1", 'alongAxis "z"', "it is one of x, y"),
    ("iiwa_outlet", "hasHole lab:Outlet-1", "hasHole lab:Table-1", "nothing has it to itself"),
    ("panda_button", '"button" ; skiros:BaseFrameId "map"', '"button"', "does not say where lab:Button-1 is"),
    ("panda_button", "pressForce 10.0", "pressForce 0", "it is above 0"),
    ("iiwa_peg", "frictionLow 0.1", "frictionLow 0.9", "is above its"),
    ("iiwa_guiding", '"person" ; skiros:BaseFrameId "map"', '"person"', "does not say where lab:Person-1 is"),
]
"""A scene, what stands in it, what shall stand there instead, and what is said of it when it is read."""

BUILT = [
    ("panda_button", "switchRange 0.0005", "switchRange 0.01", "must be below 0.003", ""),
    ("panda_button", "contact:button-sheet", "contact:socket-sheet", "no number contact:switchTravel", ""),
    ("iiwa_guiding", "strengthRange 8.0", "strengthRange 80.0", "must be below 15", ""),
    (
        "iiwa_peg",
        "contact:socket-sheet",
        "lab:own",
        "no model gone.xml",
        'lab:own a contact:FixtureSheet ; {}"gone.xml"',
    ),
    (
        "iiwa_peg",
        "contact:socket-sheet",
        "lab:own",
        "cannot be used",
        'lab:own a contact:FixtureSheet ; {}"robots/ur5e.ttl"',
    ),
]
"""The same with what is said when the cell is built, and a sheet that the scene has besides."""


def changed(scene: str, old: str, new: str, more: str = "") -> Document:
    text = catalogue.scene_path(scene).read_text("utf-8")
    assert old in text
    return Document("scene.ttl", text.replace(old, new, 1) + more)


@pytest.mark.parametrize(("scene", "old", "new", "words"), READ)
def test_a_wrong_fact_is_told_when_the_scene_is_read(scene: str, old: str, new: str, words: str) -> None:
    with pytest.raises(SceneError) as caught:
        load_documents([changed(scene, old, new), *sheet_documents()], vocabulary())
    assert words in str(caught.value)


@pytest.mark.parametrize(("scene", "old", "new", "words", "sheet"), BUILT)
def test_facts_that_do_not_go_together_are_told_before_anything_moves(
    scene: str, old: str, new: str, words: str, sheet: str
) -> None:
    more = sheet.format("skillc:model ") + " .\n" if sheet else ""
    state = load_documents([changed(scene, old, new, more), *sheet_documents()], vocabulary())
    with pytest.raises(SheetError, match=words):
        SimulatedCell(WorldModel(state))


def test_limits_of_joints_are_as_many_as_the_joints() -> None:
    sheet = DataSheet(world("iiwa_table"), f"{SKILLC}iiwa14-sheet")
    assert sheet.limits("jointSpeeds", 7).size == 7
    with pytest.raises(SheetError, match="must be 6 numbers above 0, one for each joint"):
        sheet.limits("jointSpeeds", 6)
