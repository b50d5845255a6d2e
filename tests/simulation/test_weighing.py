"""An arm feels whether what it holds is as heavy as what it should hold."""

from __future__ import annotations

import numpy as np
import pytest
from cells import ARM, ERASER, GRIPPER, at_the_eraser, grasp, lift, reach_for_eraser, run

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.move import MoveJoints
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.primitives.weigh import Weigh
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.facts import RelationFact
from skillc_runtime.world.state.terms import CONTAIN, LOCATED, WEIGHT

SIM = pytest.mark.sim
KINDS = ("iiwa_table", pytest.param("ur5e_whiteboard", marks=SIM), pytest.param("panda_desk", marks=SIM))


def lifted(scene: str) -> SimulatedCell:
    there = at_the_eraser(scene)
    reach_for_eraser(there, scene)
    grasp(there, scene)
    lift(there, scene)
    return there


def weigh(there: SimulatedCell, scene: str, tolerance: float = 0.05) -> None:
    run(there, Weigh(there, arm=ARM[scene], gripper=GRIPPER[scene], object=ERASER, tolerance=tolerance))


def make_heavier(there: SimulatedCell, kg: float) -> None:
    """Change the true mass of the eraser by so many kg, while the arm compensates the known one."""
    there.model.body(there.scene.names[ERASER] + "/block").mass += kg
    there.refresh()
    there.advance(0.5)


def carry_aside(there: SimulatedCell, scene: str) -> None:
    """Go aside in a motion of the joints, after which an arm that takes torques is not led by its tool."""
    here = there.arm(ARM[scene]).motion.stopping_pose()
    aside = Pose(here.position + np.array([0.0, 0.03, 0.05]), here.rotation)
    run(there, MoveJoints(there, arm=ARM[scene], target=aside, pace=0.5))


@pytest.mark.parametrize("scene", KINDS)
def test_a_thing_as_heavy_as_known_is_felt_to_be_held(scene: str) -> None:
    there = lifted(scene)
    weigh(there, scene)
    known = there.world.deciding_write(RelationFact(GRIPPER[scene], CONTAIN, ERASER))
    assert known is not None and (known.evidence, known.origin) == ("sensed", "Weigh")


@pytest.mark.parametrize(
    ("scene", "kg", "felt", "led"),
    [
        ("iiwa_table", 0.3, r"0\.4\d", "line"),
        ("iiwa_table", -0.08, r"0\.0\d", "joints"),
        pytest.param("ur5e_whiteboard", 0.3, r"0\.4\d", "joints", marks=SIM),
        pytest.param("panda_desk", -0.08, r"0\.0\d", "joints", marks=SIM),
    ],
)
def test_a_thing_of_another_weight_is_something_else(scene: str, kg: float, felt: str, led: str) -> None:
    there = lifted(scene)
    make_heavier(there, kg)
    if led == "joints":
        carry_aside(there, scene)
    with pytest.raises(
        SkillFailure, match=rf"holds weighs {felt} kg, lab:Eraser-1 weighs 0\.12 kg: it is something else"
    ):
        weigh(there, scene)
    state, lost = there.world.snapshot(), RelationFact(GRIPPER[scene], CONTAIN, ERASER, holds=False)
    known = there.world.deciding_write(lost)
    assert not state.holds(GRIPPER[scene], CONTAIN, ERASER) and state.value(ERASER, LOCATED) is False
    assert known is not None and known.evidence == "sensed" and known.origin.startswith("Weigh: what ")
    assert there.gripper(GRIPPER[scene]).holding == ERASER, "something is still between the fingers"


def test_an_arm_that_measures_nothing_feels_no_weight() -> None:
    scene = "iiwa_table"
    there = lifted(scene)
    there._drivers[ARM[scene]].measured.felt_wrench = lambda: None
    with pytest.raises(SkillFailure, match="lab:Iiwa-1 measures neither forces nor torques: it cannot feel whether "):
        weigh(there, scene)


def test_a_weight_below_the_tolerance_tells_nothing() -> None:
    scene = "iiwa_table"
    there = lifted(scene)
    there.world.commit([SetProperty(ERASER, WEIGHT, 0.02)])
    with pytest.raises(
        SkillFailure, match=r"lab:Eraser-1 weighs 0\.02 kg: an arm that feels weights to 0\.05 kg cannot"
    ):
        weigh(there, scene)


def test_an_empty_gripper_has_nothing_to_weigh() -> None:
    with pytest.raises(SkillFailure, match="lab:Robotiq-1 does not hold lab:Eraser-1"):
        weigh(at_the_eraser("iiwa_table"), "iiwa_table")
