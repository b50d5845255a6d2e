"""`skillc add` writes files that have no problem, and a device that a scene can use at once."""

from __future__ import annotations

from pathlib import Path

import pytest

from projects.folders import call, checked


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
        ("robot", "iiwa14", ("lab:Arm-1 a my_cell:BigOne", "lab:Arm-1 skillc:hasSheet my_cell:big_one-sheet")),
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


def test_what_cannot_be_added_is_refused_in_words(project: Path) -> None:
    for arguments, words in (
        (("robot", "Six"), "not a valid name"),
        (("robot", "six", "--like", "ur6e"), "did you mean `ur5e`"),
        (("skill", "six", "--like", "ur5e"), "--like is for robots"),
    ):
        refused = call(project, "add", *arguments)
        assert refused.exit_code == 2 and words in refused.stderr, refused.output
    outside = call(project.parent, "add", "skill", "six")
    assert outside.exit_code == 2 and "no skillc.toml" in outside.stderr
