"""Plans of shipped tasks go in space; surfaces and things that arms cannot work at are refused with the cause."""

import json
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from refinement.scenes import write_door
from skillc.cli.main import skillc
from skillc.services.space import claims as space_claims
from skillc_runtime.collision.arm_parts import ArmParts
from skillc_runtime.execution.refinement.situation import RefinedMotion


def plan(*arguments):
    ran = CliRunner().invoke(skillc, ["plan", *arguments, "--json", "--no-plan-cache"])
    return json.loads(ran.stdout)


def plan_door(tmp_path: Path, x: float, pitch_deg: float, z: float):
    scene = write_door(tmp_path, x, pitch_deg, z)
    return plan("--library", "wiping", "--scene", str(scene), "--goal", "lab:Desk-1.isClean == true")


@pytest.mark.slow
@pytest.mark.parametrize("task", ["wiping:clean_table", "wiping:clean_whiteboard", "sorting:sort_parts"])
def test_shipped_plans_are_checked_whole(task):
    answer = plan(task)
    postures = answer["space"].pop("postures")
    moving = [number for number, each in enumerate(answer["plan"], 1) if each["skill"] != "Drive"]
    assert {each["step"] for each in postures} == set(moving)
    put_down = [number for number, each in enumerate(answer["plan"], 1) if each["skill"] == "Place"]
    assert [each["step"] for each in answer["space"].pop("places")] == put_down
    assert answer["space"] == {
        "checked": len(answer["plan"]),
        "steps": len(answer["plan"]),
        "unseen": [],
        "apart": [],
        "stands": [],
        "ways": [],
        "implementations": [],
        "failure": None,
        "stopped": "",
        "from_home": True,
    }
    assert len(answer["plan"]) >= 2


@pytest.mark.slow
def test_a_door_that_the_arm_can_wipe_and_one_at_which_a_joint_would_leave_its_range(tmp_path):
    assert plan_door(tmp_path, 0.55, -20.0, 0.95)["space"]["failure"] is None
    near = plan_door(tmp_path, 0.45, -20.0, 0.75)
    assert near["status"] == "gave-up"
    assert "FollowPath: lab:Panda-1: joint 4 would be at -3." in near["failure"]
    far = plan_door(tmp_path, 0.55, 0.0, 0.75)
    assert "the tool of lab:Panda-1 does not get to (0.7" in far["failure"]


@pytest.mark.slow
def test_what_nobody_looked_at_is_said():
    space = plan("contact:insert_peg")["space"]
    assert {each["what"] for each in space["unseen"]} >= {"Insert > SinkBelow"}
    assert {each["step"] for each in space["unseen"]} == {2}


def test_where_nothing_can_look_that_is_said(monkeypatch):
    monkeypatch.setattr(space_claims, "missing_extras", lambda *extras: extras)
    ran = CliRunner().invoke(skillc, ["plan", "wiping:clean_table"])
    assert ran.exit_code == 0
    why = "what looks at it is not installed: pip install 'skillc[run]'"
    assert ran.stdout.splitlines()[-1] == f"not checked in space: {why}"
    assert plan("wiping:clean_table")["space"]["stopped"] == why


def test_without_geometry_nothing_is_said_about_space():
    assert "space" not in plan("wiping:clean_table", "--no-geometry")


@pytest.mark.slow
def test_what_is_planned_is_where_the_arms_go():
    """Each motion begins where the last one of its arm ended, and tools are where the steps bring them."""
    from refinement.loading import refined

    found = refined("sorting:sort_parts")
    assert found.failed is None
    motions = [motion for step in found.steps for motion in step.motions]
    assert len(motions) > 12
    assert sum(motion.along for motion in motions) > 6
    for one, other in pairwise(motions):
        assert np.abs(one.postures[-1] - other.postures[0]).max() < (0.3 if other.along else np.inf)
    lowering = [each for each in found.steps[1].motions if each.along][1]
    assert lowered_m(lowering) == pytest.approx(0.01, abs=1e-3), "until the part stands, before it is let go"


def lowered_m(motion: RefinedMotion) -> float:
    """Return by how much the hand is lower after a motion, in m."""
    parts = ArmParts(motion.assembly)
    before, after = (parts.place(q)[0][-1, 2] for q in (motion.start, motion.postures[-1]))
    return float(before - after)
