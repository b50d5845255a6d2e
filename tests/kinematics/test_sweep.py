"""Sweeps put the tool where the path says, with the margins and torques that MuJoCo finds for their postures."""

import mujoco
import numpy as np
import pytest
from test_inverse import load

from skillc_runtime.kinematics.chain import pack, read_chain, unpack
from skillc_runtime.kinematics.inverse import find_postures
from skillc_runtime.kinematics.sweep import MARGIN, TORQUE, JointLoad, follow, sample_poses
from skillc_runtime.motion.pose import Pose

FORCE = np.array([0.0, 3.0, -12.0])
CIRCLE = 0.015 * np.array([[1.0, 0, 0], [0, 1.0, 0], [-1.0, 0, 0], [0, -1.0, 0]])


def lanes(side_m, height_m):
    down = np.diag([1.0, -1.0, -1.0])
    ends = [(x, y) for x in np.linspace(-side_m, side_m, 4) for y in (-side_m, side_m)]
    return [Pose(np.array([0.55 + x, y, height_m]), down) for x, y in ends]


def arm(name, effort=60.0):
    model = load(name)
    limits = model.jnt_range.copy()
    return model, read_chain(model, "flange"), JointLoad(limits, np.full(model.nv, effort), FORCE, model.opt.gravity)


@pytest.mark.parametrize("name", ["panda", "iiwa14", "ur5e"])
def test_lanes_with_circles_are_followed_and_loads_are_those_of_mujoco(name):
    model, chain, bearing = arm(name)
    poses, data = sample_poses(lanes(0.1, 0.4), 0.01, CIRCLE), mujoco.MjData(model)
    starts = find_postures(chain, unpack(poses[0]), bearing.limits, bearing.limits.mean(axis=1))
    best = max((follow(chain, poses, q, bearing) for q in starts), key=lambda each: each.reached.mean())
    assert len(poses) > 100
    assert best.reached.all()
    J = np.empty((3, model.nv))
    for q, pose, measured in zip(best.postures[::10], poses[::10], best.measures[::10], strict=True):
        assert np.abs(chain.place_tool(q).position - pose[:3]).max() < 1e-3
        data.qpos[:] = q
        mujoco.mj_forward(model, data)
        mujoco.mj_jacSite(model, data, J, None, model.site("flange").id)
        assert np.abs(data.qfrc_bias + J.T @ FORCE).max() / 60.0 == pytest.approx(measured[TORQUE], abs=1e-6)
        assert np.minimum(q - bearing.limits[:, 0], bearing.limits[:, 1] - q).min() == pytest.approx(measured[MARGIN])
    assert np.abs(np.diff(best.postures, axis=0)).max() < 0.35


def test_what_is_too_far_too_wide_or_too_heavy_is_not_reached():
    _, chain, bearing = arm("iiwa14")
    poses = sample_poses(lanes(0.1, 0.4), 0.02)
    start = find_postures(chain, unpack(poses[0]), bearing.limits, bearing.limits.mean(axis=1))[0]
    weak = JointLoad(bearing.limits, np.full(7, 15.0), FORCE, bearing.gravity)
    assert follow(chain, poses, start, bearing).reached[0]
    assert not follow(chain, poses, start, weak).reached.any()
    near = unpack(poses[0])
    far = sample_poses([near, Pose(np.array([1.3, 0.0, 0.3]), near.rotation)], 0.02)
    reached = follow(chain, far, start, bearing).reached
    assert reached[0] and not reached[-1]


def test_poses_that_are_far_apart_near_a_singularity_are_followed():
    _, chain, bearing = arm("panda", effort=1e3)
    rng, stretched = np.random.default_rng(3), np.array([0.0, 0.3, 0.0, -0.5, 0.0, 1.2, 0.0])
    for _ in range(40):
        there = stretched + rng.uniform(-0.3, 0.3, 7)
        poses = np.array([pack(chain.place_tool(q)) for q in (stretched, there)])
        assert follow(chain, poses, stretched, bearing).reached.all()
