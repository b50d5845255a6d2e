"""What one arm does not reach another one takes; where neither reaches both ends, one hands it to the other."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from refinement.two_arms import write_two_arms
from skillc.cli.main import skillc

FAR_M = 1.5
"""How far apart the bases are: both arms reach the middle of the table, and neither the other half of it."""

HAND_OVER = """
use skiros
prefix lab: <http://example.org/lab#>
import "handling.skill"

task hand_over {
    scene "cell.ttl"
    goal  lab:Box-A contain lab:Part-A
}
"""

NEAR_ONE, NEAR_OTHER = (-0.35, 0.2), (0.4, -0.2)


def ask(command: str, scene: Path, goal: str, *options: str) -> dict:
    limits = ("--deadline", "120") if command == "plan" else ()
    asked = [command, "--library", "sorting", "--scene", str(scene), "--goal", goal, "--json", *limits, *options]
    return json.loads(CliRunner().invoke(skillc, asked).stdout)


def steps(answer: dict) -> list[tuple[str, ...]]:
    named = ((each["skill"], each["arguments"]) for each in answer["plan"])
    return [(skill, given["arm"], *((given["to"],) if "to" in given else ())) for skill, given in named]


@pytest.mark.slow
def test_the_arm_that_reaches_part_and_box_takes_it(tmp_path: Path) -> None:
    for x, arm in ((-0.35, "lab:Arm-1"), (0.35, "lab:Arm-2")):
        scene = write_two_arms(tmp_path, {"Part-A": (x, 0.2), "Box-A": (x, -0.2)}, FAR_M)
        answer = ask("plan", scene, "lab:Box-A contain lab:Part-A", "--no-plan-cache")
        assert steps(answer) == [("Pick", arm), ("Place", arm, "lab:Box-A")]
        assert answer["space"]["checked"] == 2


@pytest.mark.slow
def test_a_part_is_handed_over_on_the_table_between_two_arms(tmp_path: Path) -> None:
    scene = write_two_arms(tmp_path, {"Part-A": NEAR_ONE, "Box-A": NEAR_OTHER}, FAR_M)
    answer = ask("plan", scene, "lab:Box-A contain lab:Part-A", "--no-plan-cache")
    assert steps(answer) == [
        ("Pick", "lab:Arm-1"),
        ("Place", "lab:Arm-1", "lab:Cell"),
        ("Pick", "lab:Arm-2"),
        ("Place", "lab:Arm-2", "lab:Box-A"),
    ]
    assert (answer["space"]["checked"], answer["space"]["failure"]) == (4, None)
    assert answer["optimal"] == "optimal for the filtered problem"
    why = " ".join(each["why"] for each in answer["left_out"] if each["kind"] == "steps")
    assert "no posture of lab:Arm-2 brings its tool to (0.40, 0.20" in why


@pytest.mark.slow
def test_where_no_place_between_is_in_reach_of_both_there_is_no_plan(tmp_path: Path) -> None:
    scene = write_two_arms(tmp_path, {"Part-A": (-0.8, 0.2), "Box-A": (0.8, -0.2)}, 2.4)
    answer = ask("plan", scene, "lab:Box-A contain lab:Part-A", "--no-plan-cache")
    assert answer["status"] == "gave-up"
    assert "the arms can carry out none" in answer["failure"] and "lab:Part-A" in answer["failure"]


@pytest.mark.slow
def test_several_parts_go_over_a_tray_one_after_another(tmp_path: Path) -> None:
    """That an arm does not reach one box is found for all boxes and parts of the plan at once."""
    places = {
        "Part-A": NEAR_ONE,
        "Part-B": (-0.35, 0.35),
        "Box-A": NEAR_OTHER,
        "Box-B": (0.4, -0.4),
        "Tray": (0.0, 0.0),
    }
    scene = write_two_arms(tmp_path, places, FAR_M)
    goal = "lab:Box-A contain lab:Part-A and lab:Box-B contain lab:Part-B"
    answer = ask("plan", scene, goal, "--no-plan-cache")
    assert answer["space"]["checked"] == len(answer["plan"]) == 8
    assert steps(answer).count(("Place", "lab:Arm-1", "lab:Tray")) == 2


@pytest.mark.slow
def test_check_has_nothing_against_a_hand_over(tmp_path: Path) -> None:
    write_two_arms(tmp_path, {"Part-A": NEAR_ONE, "Box-A": NEAR_OTHER}, FAR_M)
    (tmp_path / "tasks.skill").write_text(HAND_OVER)
    ran = CliRunner().invoke(skillc, ["check", str(tmp_path), "--json", "--no-cache"])
    assert (json.loads(ran.stdout), ran.exit_code) == ([], 0)


@pytest.mark.sim
def test_a_handed_over_part_arrives_and_the_arms_do_not_touch(tmp_path: Path) -> None:
    scene = write_two_arms(tmp_path, {"Part-A": NEAR_ONE, "Box-A": NEAR_OTHER}, FAR_M)
    result = ask("run", scene, "lab:Box-A contain lab:Part-A", "--no-film")
    assert (result["status"], result["failure"], result["touches"]) == ("succeeded", None, [])
    assert [(each["skill"], each["arguments"]["arm"]["label"]) for each in result["plan"]] == [
        ("Pick", "lab:Arm-1"),
        ("Place", "lab:Arm-1"),
        ("Pick", "lab:Arm-2"),
        ("Place", "lab:Arm-2"),
    ]
