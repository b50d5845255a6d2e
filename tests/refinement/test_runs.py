"""Runs look at their plans in space, from where the arms are, before anything moves."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from refinement.scenes import write_door
from skillc.cli.main import skillc

GOAL = ("--library", "wiping", "--goal", "lab:Desk-1.isClean == true")


def run(*arguments: str) -> tuple[int, dict]:
    ran = CliRunner().invoke(skillc, ["run", *arguments, "--json", "--no-film"])
    return ran.exit_code, json.loads(ran.stdout)


@pytest.mark.slow
def test_what_the_arm_cannot_wipe_is_refused_before_it_moves(tmp_path: Path) -> None:
    door = write_door(tmp_path, 0.45, -20.0, 0.75)
    code, result = run(*GOAL, "--scene", str(door))
    assert (code, result["status"], result["sim_time_s"]) == (3, "refused", 0.0)
    assert "Wipe(lab:Desk-1, lab:Panda-1" in result["failure"]
    assert "does not go: FollowPath: lab:Panda-1: joint 4 would be at -3." in result["failure"]


@pytest.mark.slow
def test_without_geometry_it_moves_and_what_lacks_space_is_not_repeated(tmp_path: Path) -> None:
    """Where the desk is, is sensed again in each wipe: that is no reason to try the same wipe again."""
    door = write_door(tmp_path, 0.45, -20.0, 0.75)
    code, result = run(*GOAL, "--scene", str(door), "--no-geometry", "--backend", "kinematic")
    assert (code, result["status"]) == (3, "failed") and result["sim_time_s"] > 5.0
    assert [(each["skill"], each["status"]) for each in result["plan"]] == [("Pick", "success"), ("Wipe", "failure")]
    assert "outside its range" in result["failure"]
    assert result.get("plan_in_space") is None


@pytest.mark.slow
def test_a_run_says_that_its_plan_is_checked_in_space(tmp_path: Path) -> None:
    ran = CliRunner().invoke(
        skillc, ["run", "clean_table", "--backend", "kinematic", "--out", str(tmp_path), "--no-film"]
    )
    assert ran.exit_code == 0
    assert "Pick -> Wipe (about " in ran.stderr and "proved optimal, all 2 checked in space)" in ran.stderr
    assert "proved optimal, all 2 checked in space" in ran.stdout
    assert "all 2 checked in space" in (tmp_path / "report.html").read_text()
    claim = json.loads((tmp_path / "result.json").read_text())["plan_in_space"]
    assert (claim["checked"], claim["steps"], claim["failure"], claim["stopped"]) == (2, 2, None, "")
    told = CliRunner().invoke(skillc, ["why", str(tmp_path)])
    assert "all 2 checked in space: reach, joints, torques, paths, room; the arms begin at home" in told.stdout
