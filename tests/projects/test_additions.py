"""`skillc add` writes files that have no problem, and a device that a scene can use at once."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest

from projects.folders import call, checked
from skillc_ontology import catalogue

FARTHER = "lab:Board-1.PositionX == 0.58 m"
"""Where an iiwa in the place of a Panda can wipe the whole board."""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    assert call(tmp_path, "new", "my_cell", "--template", "wipe").exit_code == 0
    return tmp_path / "my_cell"


def test_a_skill_has_no_problem(project: Path) -> None:
    made = call(project / "tests", "add", "skill", "rinse_board")
    assert made.stdout == "../rinse_board.skill\n"
    assert checked(project) == []
    assert call(project, "fmt", "--check").exit_code == 0
    again = call(project, "add", "skill", "rinse_board")
    assert again.exit_code == 2 and "already" in again.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "like", "edits"),
    [
        ("robot", "iiwa14", ("lab:Arm-1 a my_cell:BigOne", "lab:Arm-1 skillc:hasSheet my_cell:big_one-sheet", FARTHER)),
        ("robot", "ur5e", ()),
        ("gripper", "wsg50", ("lab:Hand-1 a my_cell:BigOne", "lab:Hand-1 skillc:hasSheet my_cell:big_one-sheet")),
        ("gripper", "robotiq_3f", ()),
        ("tool", "eraser", ("lab:Eraser-1 skillc:hasSheet my_cell:big_one-sheet",)),
        ("tool", "peg", ()),
    ],
)
def test_a_device_is_used_by_the_scene(kind: str, like: str, edits: tuple[str, ...], project: Path) -> None:
    made = call(project, "add", kind, "big_one", "--like", like)
    assert made.exit_code == 0, made.output
    assert made.stdout.split() == [f"ontology/{kind}s/big_one.ttl", f"ontology/{kind}s/big_one.xml", "skillc.toml"]
    assert 'ontology = ["ontology"]' in (project / "skillc.toml").read_text("utf-8")
    assert checked(project) == []
    old = {"robot": "not lab:Arm-1 a skillc:Panda", "gripper": "not lab:Hand-1 a skillc:PandaHand"}
    if edits:
        removed = (old[kind],) if kind in old else ()
        edited = call(project, "scene", "edit", "cell.ttl", *edits[:1], *removed, *edits[1:])
        assert edited.exit_code == 0, edited.output
        assert [each for each in checked(project) if each["severity"] == "error"] == []
        planned = call(project, "plan", "--json")
        assert planned.exit_code == 0, planned.output


@pytest.mark.parametrize(
    ("like", "old", "new"),
    [
        ("eraser", (0.1, 0.05, 0.03), (0.14, 0.07, 0.04)),
        ("polisher", (0.08, 0.06, 0.03), (0.05, 0.12, 0.02)),
        ("peg", (0.02, 0.02, 0.06), (0.03, 0.03, 0.05)),
    ],
)
def test_a_tool_of_another_size_has_it_in_model_sheet_and_scene(
    like: str, old: tuple[float, ...], new: tuple[float, ...], project: Path
) -> None:
    shipped = mujoco.MjModel.from_xml_path(str(catalogue.model_path(f"tools/{like}.xml")))
    for name, size in (("same", old), ("other", new)):
        made = call(project, "add", "tool", name, "--like", like, "--size", *map(str, size))
        assert made.exit_code == 0 and f"skiros:SizeX {size[0]:g} ; skiros:SizeY {size[1]:g}" in made.stderr, (
            made.output
        )
        model = mujoco.MjModel.from_xml_path(str(project / f"ontology/tools/{name}.xml"))
        share = np.prod(size) / np.prod(old)
        assert model.body_mass.sum() == pytest.approx(shipped.body_mass.sum() * share, rel=1e-3)
        face, handle = model.geom("face"), model.geom("handle")
        assert face.size[:2] * 2 == pytest.approx(size[:2])
        assert handle.size == pytest.approx(shipped.geom("handle").size)
        ribs = [model.geom(each) for each in range(model.ngeom) if model.geom(each).name.startswith("rib")]
        for rib in ribs:
            axis = np.empty(9)
            mujoco.mju_quat2Mat(axis, rib.quat)
            reach = np.abs(rib.pos) + np.abs(axis.reshape(3, 3)[:, 2]) * rib.size[1] + rib.size[0]
            assert reach[:2] == pytest.approx(np.array(size[:2]) / 2) and rib.size[0] == pytest.approx(size[2] / 4)
        if name == "same":
            assert model.body_inertia == pytest.approx(shipped.body_inertia, rel=1e-3)


@pytest.mark.slow
def test_a_scene_with_a_resized_tool_has_no_problem(project: Path) -> None:
    made = call(project, "add", "tool", "sponge", "--size", "0.14", "0.07", "0.04")
    stated = made.stderr.partition(": skillc:")[2].rstrip(" .\n")
    edits = [f"lab:Eraser-1 {each.strip()}" for each in f"skillc:{stated}".split(" ;")]
    assert len(edits) == 5
    assert call(project, "scene", "edit", "cell.ttl", *edits).exit_code == 0
    assert checked(project) == []


def test_what_cannot_be_added_is_refused_in_words(project: Path) -> None:
    for arguments, words in (
        (("robot", "Six"), "not a valid name"),
        (("robot", "six", "--like", "ur6e"), "did you mean `ur5e`"),
        (("skill", "six", "--like", "ur5e"), "--like is for robots"),
        (("skill", "six", "--size", "1", "1", "1"), "--size is for `skillc add tool`"),
        (("tool", "six", "--size", "140", "70", "40"), "three lengths in m, each from 0.005 to 1"),
        (("tool", "six", "--size", "0.1", "0.02", "0.05"), "wider than half of its height"),
    ):
        refused = call(project, "add", *arguments)
        assert refused.exit_code == 2 and words in refused.stderr, refused.output
    outside = call(project.parent, "add", "skill", "six")
    assert outside.exit_code == 2 and "no skillc.toml" in outside.stderr
