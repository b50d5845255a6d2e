"""The page on robots is true: its table is what ships, its example is followed, and no code knows a robot by name."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import mujoco
import pytest

from docs.pages import ROOT, Reader
from skillc.services.library import libraries
from skillc_ontology import catalogue
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.data_sheet import DataSheet
from skillc_runtime.world.state.terms import SKILLC

PAGE = ROOT / "docs/robots.md"
ROW = re.compile(r"^\| [^|]+ \| `skillc:(\w+)` \| `(\w+/(\w+)\.xml)` \| ([^|]+) \|$", re.MULTILINE)
INTERFACES = ("extras.py", "terms.py", "unread.py")
"""Files that name the back end of that name."""
CODE = ("app", "runtime", "compiler", "dsl", "ontology")


def test_the_table_says_what_the_sheets_say() -> None:
    state = load_scene(catalogue.scene_path("iiwa_table"), libraries.load_vocabulary())
    rows = ROW.findall(PAGE.read_text("utf-8"))
    assert {model for _, model, _, _ in rows} == {
        path.relative_to(catalogue.ROOT).as_posix()
        for folder in ("robots", "grippers")
        for path in (catalogue.ROOT / folder).glob("*.xml")
    }
    for cls, model, name, limits in rows:
        assert SKILLC + cls in state.vocabulary.classes
        sheet = DataSheet(state, f"{SKILLC}{name.replace('_', '-')}-sheet")
        assert sheet.text("model") == model
        assert limits == _limits(sheet, model)


def _limits(sheet: DataSheet, model: str) -> str:
    if model.startswith("grippers/"):
        opening, force = sheet.number("maxOpening"), sheet.number("maxForce")
        return f"opens to {1000 * opening:.0f} mm, grasps with up to {force:.0f} N"
    joints = mujoco.MjModel.from_xml_path(str(catalogue.model_path(model))).njnt
    return f"{joints} joints, reach {sheet.number('reach'):g} m, skills push up to {sheet.number('forceLimit'):.0f} N"


def test_no_code_and_no_skill_knows_the_last_arm_by_name() -> None:
    code = [
        path
        for folder in CODE
        for path in (ROOT / folder).rglob("*.py")
        if path.parent.name != "franka" and path.name not in INTERFACES
    ]
    skills = [
        path for path in (ROOT / "skills_src").rglob("*.skill") if path.name not in ("tasks.skill", "tests.skill")
    ]
    assert len(code) > 500 and len(skills) > 10
    named = re.compile(r"panda(?!s)|franka(?!\s+Control)|\bfr3\b", re.IGNORECASE)
    assert [path for path in (*code, *skills) if named.search(path.read_text("utf-8"))] == []


def follow(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Reader:
    monkeypatch.chdir(folder)
    (folder / "own/robots").mkdir(parents=True)
    shutil.copy(catalogue.scene_path("panda_desk"), folder / "cell.ttl")
    reader = Reader(monkeypatch)
    reader.follow(PAGE)
    return reader


@pytest.mark.sim
def test_an_arm_is_added_by_two_files_and_wipes_the_desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert follow(tmp_path, monkeypatch).done == 3
    before, after = (
        path.read_text("utf-8").splitlines() for path in (catalogue.scene_path("panda_desk"), Path("cell.ttl"))
    )
    assert sum(one != other for one, other in zip(before, after, strict=True)) == 2, "two lines of the scene differ"
