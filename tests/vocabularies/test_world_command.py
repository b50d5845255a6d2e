"""`skillc world`: searching, showing, comparing and drawing scenes; `skillc scene edit`."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc_ontology import catalogue


@pytest.fixture
def scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return Path(shutil.copy(catalogue.scene_path("iiwa_table"), "cell.ttl"))


def world(*arguments: str | Path) -> Result:
    return invoke("world", *map(str, arguments))


def edit(scene: str | Path, *edits: str) -> Result:
    return invoke("scene", "edit", str(scene), *edits)


def invoke(*arguments: str) -> Result:
    result = CliRunner().invoke(skillc, arguments)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def test_words_are_searched_in_names_labels_and_classes(scene: Path) -> None:
    def found(words: str) -> list[str]:
        return [each["individual"] for each in json.loads(world(scene, "--search", words, "--json").stdout)]

    assert found("table top") == ["lab:Table-1"]
    assert found("THREE-finger") == ["lab:Robotiq-1"]
    assert found("graspingpose eraser") == ["lab:Eraser-1-grasp"]
    nothing = world(scene, "--search", "zebra")
    assert (nothing.exit_code, nothing.stdout) == (1, "") and "`zebra`" in nothing.stderr


def test_an_individual_is_shown_with_what_leads_to_it_and_what_follows(scene: Path) -> None:
    text = world(scene, "--show", "lab:Eraser-1").stdout
    assert "  from     lab:Cell skiros:contain\n" in text and "  follows  skillc:within lab:Scene-1\n" in text
    (data,) = json.loads(world(scene, "--show", "lab:Eraser-1", "--json").stdout)
    assert ["lab:Cell", "skiros:contain"] in data["from"] and "skillc:Tool" in data["also"]
    wrong = world(scene, "--show", "lab:Erasor-1")
    assert wrong.exit_code == 1 and "did you mean lab:Eraser-1" in wrong.stderr


def test_two_scenes_are_compared(scene: Path) -> None:
    assert world(scene, "--diff", "iiwa_table").stdout == "no differences\n"
    assert edit(scene, "lab:Eraser-1 skiros:Weight 0.2").exit_code == 0
    assert world("iiwa_table", "--diff", scene).stdout == (
        "- lab:Eraser-1 skiros:Weight 0.12\n+ lab:Eraser-1 skiros:Weight 0.2\n"
    )
    data = json.loads(world("iiwa_table", "--diff", scene, "--json").stdout)
    assert data["added"] == [{"subject": "lab:Eraser-1", "predicate": "skiros:Weight", "value": "0.2"}]


def test_a_scene_is_drawn_with_each_individual_in_one_box(scene: Path) -> None:
    result = world(scene, "--graph", "out/cell.svg")
    assert result.stdout == "out/cell.svg\n"
    picture = ElementTree.parse("out/cell.svg")
    titles = [each.text for each in picture.iter() if each.get("class") == "title"]
    listed = [each["individual"] for each in json.loads(world(scene, "--json").stdout)]
    assert sorted(titles) == sorted(["cell.ttl", *listed]) and len(listed) > 8
    first = Path("out/cell.svg").read_bytes()
    world(scene, "--graph", "out/cell.svg")
    assert Path("out/cell.svg").read_bytes() == first
    assert world(scene, "--graph", "cell.ttl/x.svg").exit_code == 1


def test_all_edits_are_made_and_the_rest_of_the_file_stays(scene: Path) -> None:
    before = scene.read_text("utf-8")
    edits = ("lab:Cup-1 a skiros:Product", 'lab:Cup-1 rdfs:label "cup"', "lab:Cup-1 skiros:at lab:Cell")
    result = edit(scene, *edits)
    assert (result.exit_code, result.stdout, result.stderr) == (0, "", "cell.ttl: 3 edits applied\n")
    assert scene.read_text("utf-8").startswith(before)
    assert edit(scene, "lab:Cup-1 skiros:at lab:Cell").stderr == "cell.ttl already states this\n"
    assert edit(scene, "not lab:Cup-1").exit_code == 0
    assert world("iiwa_table", "--diff", scene).stdout == "no differences\n"


@pytest.mark.slow
def test_facts_are_edited_in_the_syntax_in_which_they_are_shown(scene: Path) -> None:
    made = ("lab:Eraser-1.Weight == 200 g", "not lab:Cell contain lab:Table-1", "lab:Cell contain lab:Table-1")
    assert edit(scene, *made, 'lab:Eraser-1-grasp.FrameId == "a b == c"').exit_code == 0
    text = scene.read_text(encoding="utf-8")
    assert "skiros:Weight 0.2" in text and '"a b == c"' in text
    shown = [line.strip() for line in world(scene).stdout.splitlines()]
    assert "skiros:contain lab:Table-1" in shown


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ("lab:Eraser-1 skiros:at lab:Eraser-1", "irreflexive"),
        ("lab:Eraser-1 skiros:wieght 0.2", "did you mean `skiros:Weight`"),
        ("lab:Eraser-1 skiros:Weight", "has no value"),
        ('lab:Eraser-1 skiros:Weight "heavy"', "skiros:Weight"),
        ("not lab:Eraser-1 skiros:Weight 7", "does not state"),
        ("not lab:Cell skillc:holdsDeep lab:Eraser-1", "follows from other statements"),
        ("not lab:Zebra-1", "does not state"),
        ("lab:Eraser-1 skiros:Weight 0.2 . lab:Cell a skiros:Scene", "not one fact"),
        ("lab:Eraser-1.Wieght == 0.2 kg", "no property Wieght; did you mean Weight"),
        ("lab:Eraser-1.Weight == 2 N", "Weight is in kg, g, and this is in N"),
        ("lab:Eraser-1.Weight == heavy", "Weight is written like `0.1 kg`"),
        ("lab:Eraser-1.Weight = 2 kg", "has `==`"),
        ("lab:Cell contains lab:Eraser-1", "no relation contains; did you mean contain"),
        ("lab:Rag-1 is Cloht", "no class Cloht"),
        ("zoo:Zebra a skiros:Product", "`zoo:` is not declared"),
        ("not lab:Eraser-1", "nothing has this FrameId"),
    ],
)
def test_an_edit_that_makes_no_sense_changes_nothing(scene: Path, change: str, reason: str) -> None:
    before = scene.read_bytes()
    result = edit(scene, "lab:Eraser-1 skiros:Weight 0.3", change)
    assert (result.exit_code, result.stdout) == (1, "") and reason in result.stderr
    assert scene.read_bytes() == before


def test_questions_that_do_not_go_together_are_a_wrong_command_line(scene: Path) -> None:
    assert world(scene, "--search", "x", "--show", "lab:Cell").exit_code == 2
    moved = world(scene, "--edit", "not lab:Cell")
    assert moved.exit_code == 2 and "skillc scene edit cell.ttl 'not lab:Cell'" in moved.stderr
    shipped = edit("iiwa_table", "lab:Eraser-1 skiros:Weight 1")
    assert shipped.exit_code == 1 and "copy it" in shipped.stderr


def test_a_scene_beside_skills_may_use_their_terms(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert CliRunner().invoke(skillc, ["new", "press"]).exit_code == 0
    assert "lab:Panel-1" in world(Path("press/cell.ttl"), "--search", "Panel").stdout
    elsewhere = Path(shutil.copy("press/cell.ttl", "alone.ttl"))
    assert "there is no class press:Panel" in world(elsewhere).stderr
    assert world(elsewhere, "--library", "press").exit_code == 0
