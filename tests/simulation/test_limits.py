"""Limits of arms and grippers are the makers', and what stands in a data sheet and in a model is the same in both."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest
from cells import vocabulary

from skillc_ontology import catalogue
from skillc_runtime.control.kinematics import JOINT_RAMP_S
from skillc_runtime.motion.paths.joint import joint_motion
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.data_sheet import DataSheet
from skillc_runtime.world.state.terms import SKILLC
from skillc_runtime.world.state.world_state import WorldState

DEGREES = np.pi / 180

RANGES = {
    "ur5e": [(-360, 360), (-360, 360), (-180, 180), (-360, 360), (-360, 360), (-360, 360)],
    "iiwa14": [(-170, 170), (-120, 120), (-170, 170), (-120, 120), (-170, 170), (-120, 120), (-175, 175)],
    "fr3": [(-155, 155), (-100, 100), (-165, 165), (-171, -12), (-160, 160), (34, 256), (-172, 172)],
    "panda": [(-166, 166), (-101, 101), (-166, 166), (-176, -4), (-166, 166), (-1, 215), (-166, 166)],
}
"""deg: the makers' data sheets, the elbow of the UR5e as its maker halves it for planning. The Franka Research 3 goes
as far as the limits of its speeds, which fall towards the ends of the joints, leave what it needs to brake."""

SPEEDS = {
    "ur5e": [180] * 6,
    "iiwa14": [85, 85, 100, 75, 130, 135, 135],
    "fr3": [150.1] * 4 + [301.4, 239.5, 301.4],
    "panda": [124.6] * 4 + [149.5] * 3,
}
"""deg/s: the makers' data sheets; the Panda's and the Franka Research 3's as their interface has them, in rad/s."""

EFFORTS = {
    "ur5e": [150, 150, 150, 28, 28, 28],
    "iiwa14": [320, 320, 176, 176, 110, 40, 40],
    "fr3": [87] * 4 + [12] * 3,
    "panda": [87] * 4 + [12] * 3,
}
"""N m."""

GRIPPERS = {"wsg50": (0.110, 80.0), "robotiq_3f": (0.155, 70.0), "panda_hand": (0.080, 70.0)}
"""Greatest opening in m and force in N: the makers' data sheets."""

ARMS = sorted(RANGES)


def state() -> WorldState:
    return load_scene(catalogue.scene_path("iiwa_table"), vocabulary())


def sheet(device: str) -> DataSheet:
    return DataSheet(state(), f"{SKILLC}{device.replace('_', '-')}-sheet")


def model(device: str) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_path(str(sheet(device).model))


def test_every_arm_and_gripper_that_ships_is_looked_at() -> None:
    for folder, known in (("robots", RANGES), ("grippers", GRIPPERS)):
        assert {path.stem for path in Path(catalogue.ROOT, folder).glob("*.xml")} == set(known)


@pytest.mark.parametrize("arm", ARMS)
def test_ranges_speeds_and_efforts_are_the_makers(arm: str) -> None:
    built = model(arm)
    np.testing.assert_allclose(built.jnt_range / DEGREES, RANGES[arm], atol=0.6)
    np.testing.assert_allclose(sheet(arm).numbers("jointSpeeds") / DEGREES, SPEEDS[arm], rtol=1e-3)
    position = built.actuator_biastype[0] == mujoco.mjtBias.mjBIAS_AFFINE
    effort = built.actuator_forcerange if position else built.actuator_ctrlrange
    np.testing.assert_array_equal(effort, np.column_stack([np.negative(EFFORTS[arm]), EFFORTS[arm]]))


@pytest.mark.parametrize("arm", ARMS)
def test_an_arm_s_model_agrees_with_its_sheet(arm: str) -> None:
    built, said = model(arm), sheet(arm)
    np.testing.assert_array_equal(built.dof_armature, said.number("armature"))
    for name in ("jointSpeeds", "jointAccelerations", "jointJerks"):
        if name == "jointSpeeds" or said.has(name):
            assert said.limits(name, built.nv).shape == (built.nv,)
    home = said.posture("home")
    assert (built.jnt_range[:, 0] < home).all() and (home < built.jnt_range[:, 1]).all()
    if built.actuator_biastype[0] == mujoco.mjtBias.mjBIAS_AFFINE:
        np.testing.assert_array_equal(built.actuator_gainprm[:, 0], said.number("servoStiffness"))
        np.testing.assert_array_equal(-built.actuator_biasprm[:, 2], said.number("servoDamping"))
        np.testing.assert_array_equal(built.actuator_ctrlrange, built.jnt_range)


@pytest.mark.parametrize("arm", ARMS)
def test_reach_and_shoulder_are_those_of_the_model(arm: str) -> None:
    """The shoulder is the second joint; makers measure the reach to some point of the hand."""
    built, said = model(arm), sheet(arm)
    data = mujoco.MjData(built)
    mujoco.mj_kinematics(built, data)
    shoulder = data.xanchor[1].copy()
    assert shoulder[2] == pytest.approx(said.number("shoulderHeight"), abs=1e-3)
    farthest = np.zeros(built.njnt + 1)
    for q in np.random.default_rng(2).uniform(*built.jnt_range.T, (2000, built.nv)):
        data.qpos[:] = q
        mujoco.mj_kinematics(built, data)
        places = np.vstack([data.xanchor, data.site("flange").xpos])
        farthest = np.maximum(farthest, np.linalg.norm(places - shoulder, axis=1))
    assert farthest[3] < said.number("reach") < 1.06 * farthest[-1]


@pytest.mark.parametrize("gripper", sorted(GRIPPERS))
def test_a_gripper_s_model_agrees_with_its_sheet_and_its_maker(gripper: str) -> None:
    opening, force = GRIPPERS[gripper]
    built, said = model(gripper), sheet(gripper)
    assert (said.number("maxOpening"), said.number("maxForce")) == (opening, force)
    actuator = built.actuator("opening")
    np.testing.assert_array_equal(actuator.ctrlrange, (0.0, opening))
    np.testing.assert_array_equal(actuator.forcerange, (-force, force))
    tendon = built.actuator_trnid[actuator.id, 0]
    span = slice(built.tendon_adr[tendon], built.tendon_adr[tendon] + built.tendon_num[tendon])
    joints, shares = built.wrap_objid[span], built.wrap_prm[span]
    assert built.jnt_range[joints, 1] @ shares == pytest.approx(opening)


def test_joint_motions_keep_the_accelerations_that_a_maker_states() -> None:
    said = sheet("panda")
    speeds, most = said.numbers("jointSpeeds"), said.numbers("jointAccelerations")
    start, goal = model("panda").jnt_range.T
    motion = joint_motion(start, goal, speeds, speeds / JOINT_RAMP_S)
    fastest = np.max([np.abs(motion.at(t).ddq) for t in np.linspace(0.0, motion.duration, 500)], axis=0)
    assert (fastest <= most).all() and fastest.max() > 1.0
