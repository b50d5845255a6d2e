"""`skillc check --scene CELL --connect`: what is said of a graph that fits the scene, and of others."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from robots.ros2.running import robot
from robots.ros2.test_link import IN_ROS, SCENE
from skillc.cli.main import skillc

pytestmark = pytest.mark.slow


def check(scene: Path) -> tuple[int, str]:
    """Return the exit code and what is printed."""
    result = CliRunner().invoke(skillc, ["check", "--scene", str(scene), "--connect"])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.stdout


def test_a_scene_that_fits_has_no_finding_and_facts_that_do_not_have_one_each(tmp_path: Path) -> None:
    with robot(SCENE, tmp_path, rate_hz=125, joint_names=IN_ROS):
        assert check(SCENE) == (0, "")
        for facts, findings in WRONG.items():
            wrong = SCENE.read_text("utf-8")
            for fact in facts.split(" ; "):
                name = fact.split()[0]
                wrong = re.sub(rf"{name} [^;.]+(\.0)? ?;", "", wrong)
            (tmp_path / "wrong.ttl").write_text(f"{wrong}\nlab:Arm-1 {facts} .\n", "utf-8")
            code, text = check(tmp_path / "wrong.ttl")
            assert code == 1, facts
            for found in findings:
                assert found in text


WRONG = {
    'ros2:updateRate 500.0 ; ros2:tareService "zero" ; ros2:commandTopic "arm/commands"': (
        "messages a second; the facts say 500 (ros2:updateRate)",
        "nobody offers the service /zero (std_srvs/srv/Trigger)",
        "nobody subscribes to /arm/commands (std_msgs/msg/Float64MultiArray); there are /forward_position_controller",
    ),
    'ros2:jointNames "a b c d e elbow_joint"': ("/joint_states has no a, b, c, d, e, but",),
}
"""Facts that the graph contradicts, with what is said of them."""


@pytest.mark.long
def test_joints_in_degrees_are_found_before_anything_moves(tmp_path: Path) -> None:
    with robot(SCENE, tmp_path, rate_hz=125, joint_names=IN_ROS, degrees=True):
        code, text = check(SCENE)
    assert code == 1
    assert "is it in degrees" in text


def test_what_cannot_be_combined_is_refused() -> None:
    result = CliRunner().invoke(skillc, ["check", "--connect"])
    assert (result.exit_code, "--connect requires --scene" in result.stderr) == (2, True)
