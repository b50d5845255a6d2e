"""Inverse kinematics of the shipped arms: the share of poses that are solved, what they and the lanes of a wipe cost.

Poses are those of random postures all over the ranges; times are processor times, beside MuJoCo's forward kinematics.
"""

from __future__ import annotations

import sys
from pathlib import Path
from statistics import mean, median
from time import process_time

import mujoco
import numpy as np

from skillc_ontology import catalogue
from skillc_runtime.kinematics.chain import read_chain, unpack
from skillc_runtime.kinematics.inverse import find_posture, find_postures
from skillc_runtime.kinematics.sweep import JointLoad, follow, sample_poses
from skillc_runtime.motion.lanes import plan_lanes
from skillc_runtime.motion.pose import Pose, exp

ARMS = ("panda", "fr3", "iiwa14", "ur5e")


def measure(arm: str, poses: int) -> str:
    """Return the figures of an arm for as many random poses."""
    model = mujoco.MjModel.from_xml_path(str(Path(catalogue.__file__).parent / "robots" / f"{arm}.xml"))
    chain, limits, draw = read_chain(model, "flange"), model.jnt_range.copy(), np.random.default_rng(1)
    low, high = np.maximum(limits[:, 0], -np.pi), np.minimum(limits[:, 1], np.pi)
    rest = limits.mean(axis=1)
    find_postures(chain, chain.place_tool(rest), limits, rest)
    one, every, counts, solved = list[float](), list[float](), list[int](), 0
    for _ in range(poses):
        target = chain.place_tool(draw.uniform(low, high))
        began = process_time()
        solved += find_posture(chain, target, limits, rest) is not None
        one.append(process_time() - began)
        began = process_time()
        counts.append(len(find_postures(chain, target, limits, rest)))
        every.append(process_time() - began)
    forward = _forward_s(model)
    return (
        f"{arm}: {solved} of {poses} poses solved; one posture {1e3 * median(one):.3f} ms in the median, "
        f"{1e3 * mean(one):.3f} in the mean ({mean(one) / forward:.0f} x mj_kinematics); "
        f"{mean(counts):.1f} postures a pose in {1e3 * median(every):.2f} ms"
    )


def measure_wipe(arm: str) -> str:
    """Return what it costs to look at the lanes of a door of 0.4 m x 0.6 m, with circles, from all postures."""
    model = mujoco.MjModel.from_xml_path(str(Path(catalogue.__file__).parent / "robots" / f"{arm}.xml"))
    chain, limits = read_chain(model, "flange"), model.jnt_range.copy()
    surface = Pose(np.array([0.5, 0.0, 0.2]), exp(np.array([0.0, -np.radians(20), 0.0])))
    lanes = [surface @ each for each in plan_lanes(np.array([0.4, 0.6]), np.array([0.1, 0.06]), 0.2)]
    poses = sample_poses(lanes, 0.01, 0.015 * np.array([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]))
    load = JointLoad(limits, np.full(model.nv, 80.0), -12.0 * surface.rotation[:, 2], model.opt.gravity)
    for _ in range(2):
        began = process_time()
        starts = find_postures(chain, unpack(poses[0]), limits, limits.mean(axis=1))
        shares = [float(follow(chain, poses, q, load).reached.mean()) for q in starts]
        seconds = process_time() - began
    best, ms = max(shares), 1e3 * seconds
    return f"{arm}: {len(poses)} poses of lanes from {len(starts)} postures in {ms:.0f} ms, {best:.0%} reached"


def _forward_s(model: mujoco.MjModel) -> float:
    data, began = mujoco.MjData(model), process_time()
    for _ in range(5000):
        mujoco.mj_kinematics(model, data)
    return (process_time() - began) / 5000


if __name__ == "__main__":
    for name in ARMS:
        print(measure(name, int(sys.argv[1]) if len(sys.argv) > 1 else 1000))
        print(measure_wipe(name))
