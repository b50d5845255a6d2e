"""A base stands beside where a workstation wants it if its arm does not get to its work from there."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from simulation.cells import LAB, world
from skillc.cli.main import skillc
from skillc_ontology import catalogue
from skillc_runtime.collision.solid_geoms import find_overlap_m
from skillc_runtime.execution.refinement.situation import begin_at_home
from skillc_runtime.execution.refinement.standing import FAR_M, SAMPLES, list_stands
from skillc_runtime.primitives.space_needs import Stand
from skillc_runtime.world.space.frames import pose

STORE = "skiros:PositionX 1.5 ; skiros:PositionY -1.2 ; skiros:PositionZ 0.0 ;"
TABLE = "skiros:PositionX 0.75 ; skiros:PositionY 0.0 ; skiros:PositionZ 0.66 ."
PICKED = "lab:Wsg-1 contain lab:Eraser-1"


def write_cell(folder: Path, farther_m: float) -> Path:
    """Write the cell of the UR5e whose base is wanted that much farther from the table with the eraser."""
    text = catalogue.scene_path("ur5e_whiteboard").read_text()
    for old, there in ((STORE, f"PositionY {-1.2 + farther_m:.2f}"), (TABLE, f"PositionX {0.75 + farther_m:.2f}")):
        assert old in text
        name = there.split()[0]
        before = next(each for each in old.split(" ; ") if name in each)
        text = text.replace(old, old.replace(before, f"skiros:{there}"))
    path = folder / "cell.ttl"
    path.write_text(text)
    return path


def ask(command: str, scene: Path, *options: str) -> dict:
    asked = [command, "--library", "wiping", "--scene", str(scene), "--goal", PICKED, "--json", *options]
    return json.loads(CliRunner().invoke(skillc, asked).stdout)


def test_stands_are_near_the_first_is_the_wanted_one_and_none_is_in_furniture() -> None:
    state, robot, place = world("ur5e_whiteboard"), LAB + "Heron-1", LAB + "Store"
    wanted = pose(state, place)
    found = list(list_stands(Stand(robot, place), begin_at_home(state)))
    assert found[0].stands == () and 20 < len(found) < SAMPLES, "some are left out, where the table is"
    for each in found[1:]:
        (stand,) = each.stands
        at = pose(each.state, robot)
        assert np.allclose(at.position, wanted.apply(np.array([stand.x_m, stand.y_m, 0.0])), atol=1e-6)
        assert 0.0 < np.linalg.norm(at.position - wanted.position) <= FAR_M * np.sqrt(2)
        assert find_overlap_m(each.state, robot) == 0.0
    far = [np.hypot(each.stands[0].x_m, each.stands[0].y_m) for each in found[1:]]
    assert far[0] < 0.15 and np.mean(far[:8]) < np.mean(far[-8:])
    assert [each.stands for each in found] == [
        each.stands for each in list_stands(Stand(robot, place), begin_at_home(state))
    ]


@pytest.mark.slow
def test_where_the_wanted_pose_does_nothing_is_chosen(tmp_path: Path) -> None:
    assert ask("plan", write_cell(tmp_path, 0.0), "--no-plan-cache")["space"]["stands"] == []


@pytest.mark.slow
def test_a_base_stands_nearer_to_what_its_arm_does_not_reach(tmp_path: Path) -> None:
    scene = write_cell(tmp_path, 0.45)
    space = ask("plan", scene, "--no-plan-cache")["space"]
    (stand,) = space["stands"]
    assert (space["checked"], stand["step"], stand["place"]) == (2, 1, "lab:Store")
    result = ask("run", scene, "--no-film", "--backend", "kinematic", "--out", str(tmp_path / "run"))
    assert (result["status"], result["failure"]) == ("succeeded", None)
    (stood,) = result["plan_in_space"]["stands"]
    assert {**stood, "robot": stood["robot"]["label"], "place": stood["place"]["label"]} == stand
    told = CliRunner().invoke(skillc, ["why", str(tmp_path / "run")]).stdout
    assert f"lab:Heron-1 stands at ({stand['x_m']:.2f}, {stand['y_m']:.2f}) m from lab:Store" in told
    again = CliRunner().invoke(skillc, ["replay", str(tmp_path / "run"), "--check"])
    assert again.exit_code == 0 and "the same but for wall times" in again.output


@pytest.mark.slow
def test_what_is_too_far_from_all_stands_is_refused(tmp_path: Path) -> None:
    answer = ask("plan", write_cell(tmp_path, 1.4), "--no-plan-cache")
    assert answer["status"] == "gave-up" and "no posture of lab:Ur5e-1" in answer["failure"]
