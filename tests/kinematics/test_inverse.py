"""Chains agree with MuJoCo, and inverse kinematics finds all branches of poses that an arm can take."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from skillc_ontology import catalogue
from skillc_runtime.kinematics.chain import add_weight, differentiate, place_joints, read_chain
from skillc_runtime.kinematics.inverse import find_posture, find_postures
from skillc_runtime.motion.pose import Pose, log

ARMS = ("panda", "fr3", "iiwa14", "ur5e")
FOLDER = Path(catalogue.__file__).parent / "robots"
GANTRY = """<mujoco><compiler angle="radian"/><worldbody><body name="beam">
  <joint name="x" type="slide" axis="1 0 0" range="-1 1"/><geom size=".1" mass="3"/>
  <body name="post" pos="0 0 1"><joint name="z" type="slide" axis="0 0 1" range="-.5 .5"/><geom size=".1" mass="2"/>
  <body name="wrist" pos="0 .2 0"><joint name="turn" axis="0 0 1" range="-3 3"/><geom size=".1" pos="0 .3 0" mass="1"/>
  <site name="flange" pos="0 .4 -.1"/></body></body></body></worldbody></mujoco>"""


def load(arm):
    return (
        mujoco.MjModel.from_xml_string(GANTRY)
        if arm == "gantry"
        else mujoco.MjModel.from_xml_path(f"{FOLDER}/{arm}.xml")
    )


def find_jacobian(chain, q, tool, jacobian):
    """Fill in the pose of the tool (12,) and the Jacobian (6, nv) in base."""
    at = np.empty((chain.slides.size + 1, 12))
    place_joints(chain.frames, chain.slides, chain.tool, q, at)
    differentiate(chain.slides, at, jacobian)
    for k in range(12):
        tool[k] = at[chain.slides.size, k]


def find_gravity_torques(chain, q, gravity, torques):
    """Fill in what the joints exert (nv,) to bear the arm."""
    at = np.empty((chain.slides.size + 1, 12))
    place_joints(chain.frames, chain.slides, chain.tool, q, at)
    add_weight(chain.slides, chain.masses, chain.centres, at, gravity, torques)


@pytest.mark.parametrize("arm", [*ARMS, "gantry"])
def test_pose_jacobian_and_weight_agree_with_mujoco(arm):
    model, draw = load(arm), np.random.default_rng(2)
    chain, data = read_chain(model, "flange"), mujoco.MjData(model)
    J, torques, expected = np.empty((6, model.nv)), np.empty(model.nv), np.empty((6, model.nv))
    at = np.empty((model.nv + 1, 12))
    for _ in range(10):
        data.qpos[:] = q = draw.uniform(*model.jnt_range.T)
        mujoco.mj_forward(model, data)
        site = data.site("flange")
        mujoco.mj_jacSite(model, data, expected[:3], expected[3:], site.id)
        place_joints(chain, q, at)
        differentiate(chain.slides, at, J)
        add_weight(chain.slides, chain.masses, chain.centres, at, model.opt.gravity, torques)
        assert np.allclose(at[-1], [*site.xpos, *site.xmat], atol=1e-12)
        assert np.allclose(J, expected, atol=1e-12)
        assert np.allclose(torques, data.qfrc_bias, atol=1e-9)


@pytest.mark.parametrize("arm", ARMS)
def test_poses_that_an_arm_can_take_are_found_in_all_branches(arm):
    model, draw = load(arm), np.random.default_rng(3)
    chain, limits = read_chain(model, "flange"), model.jnt_range.copy()
    low, high = np.maximum(limits[:, 0], -np.pi), np.minimum(limits[:, 1], np.pi)
    counts = []
    for _ in range(50):
        known = draw.uniform(low, high)
        target = chain.place_tool(known)
        found = find_postures(chain, target, limits, limits.mean(axis=1))
        counts.append(len(found))
        for q in found:
            tool = chain.place_tool(q)
            assert np.abs(tool.position - target.position).max() < 2e-5
            assert np.abs(log(tool.rotation @ target.rotation.T)).max() < 2e-5
            assert ((q >= limits[:, 0]) & (q <= limits[:, 1])).all()
        assert np.array_equal(found, find_postures(chain, target, limits, limits.mean(axis=1)))
    assert min(counts) >= 1
    assert np.median(counts) >= 4


def test_an_arm_with_six_joints_finds_the_branch_of_each_posture():
    model, draw = load("ur5e"), np.random.default_rng(4)
    chain, limits = read_chain(model, "flange"), np.tile([-np.pi, np.pi], (6, 1))
    found = 0
    for _ in range(40):
        q = draw.uniform(-2.8, 2.8, 6)
        postures = find_postures(chain, chain.place_tool(q), limits, np.zeros(6))
        found += bool((np.abs(np.sin((postures - q) / 2)).max(axis=1) < 0.1).any())
    assert found >= 38


def test_the_posture_nearest_to_rest_is_preferred_and_a_pose_out_of_reach_has_none():
    model = load("iiwa14")
    chain, limits, home = read_chain(model, "flange"), model.jnt_range.copy(), np.array([0, 0.6, 0, -1.2, 0, 1.2, 0])
    near = home + 0.05
    found = find_posture(chain, chain.place_tool(near), limits, home)
    assert np.abs(found - home).max() < 0.15
    assert find_posture(chain, Pose.of((3.0, 0.0, 0.5)), limits, home) is None
    assert find_postures(chain, Pose.of((3.0, 0.0, 0.5)), limits, home).shape == (0, 7)
