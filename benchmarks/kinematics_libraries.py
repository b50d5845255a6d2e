"""Inverse kinematics beside mink and pinocchio, for random poses of shipped arms: `pip install mink daqp pin` before.

All start from the middle of the ranges, then from the same seeds, with the same number of steps. pinocchio has no
inverse kinematics of its own: it is the loop of its documentation, with the damping of ours.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from statistics import mean, median
from time import process_time

import mujoco
import numpy as np

from skillc_ontology import catalogue
from skillc_runtime.kinematics.chain import Chain, read_chain
from skillc_runtime.kinematics.inverse import (
    DAMPING,
    LEAST_DAMPING,
    LONGEST_STEP,
    SEEDS,
    STEPS,
    find_posture,
    spread_seeds,
)
from skillc_runtime.motion.pose import Array, Pose, log

ARMS = ("panda", "iiwa14", "ur5e")
CLOSE = 1e-5

Solve = Callable[[Pose, Array], Array | None]
"""Returns joints (nv,) with the tool at a pose, by a descent from others; None if it does not get there."""


def solve_with_mink(model: mujoco.MjModel) -> Solve:
    """Return a descent by quadratic programs."""
    import mink

    configuration = mink.Configuration(model)
    task = mink.FrameTask("flange", "site", 1.0, 1.0, lm_damping=1e-3)
    limits = [mink.ConfigurationLimit(model)]

    def solve(target: Pose, q: Array) -> Array | None:
        rotation = mink.SO3.from_matrix(target.rotation)
        task.set_target(mink.SE3.from_rotation_and_translation(rotation, target.position))
        configuration.update(q)
        for _ in range(STEPS):
            if np.linalg.norm(task.compute_error(configuration)) < CLOSE:
                return np.array(configuration.q)
            try:
                step = mink.solve_ik(configuration, [task], 1.0, "daqp", damping=1e-6, limits=limits)
            except mink.NoSolutionFound:
                return None
            configuration.integrate_inplace(_shorten(step), 1.0)
        return None

    return solve


def solve_with_pinocchio(path: Path, chain: Chain, limits: Array) -> Solve:
    """Return a descent by damped least squares, with joints kept within limits (nv, 2)."""
    import pinocchio

    model = pinocchio.buildModelFromMJCF(str(path))
    data, flange = model.createData(), model.getFrameId("flange")
    pinocchio.framesForwardKinematics(model, data, np.zeros(model.nv))
    zero = chain.place_tool(np.zeros(model.nv))
    # pinocchio drops the pose of a first body without joints.
    model.jointPlacements[1] = (
        pinocchio.SE3(zero.rotation, zero.position) * data.oMf[flange].inverse() * model.jointPlacements[1]
    )

    def solve(target: Pose, q: Array) -> Array | None:
        there = pinocchio.SE3(target.rotation, target.position)
        for _ in range(STEPS):
            pinocchio.framesForwardKinematics(model, data, q)
            error = pinocchio.log6(data.oMf[flange].actInv(there)).vector
            size = float(error @ error)
            if size < CLOSE * CLOSE:
                return q
            J = pinocchio.computeFrameJacobian(model, data, q, flange)
            step = J.T @ np.linalg.solve(J @ J.T + (LEAST_DAMPING + DAMPING * size) * np.eye(6), error)
            q = np.clip(q + _shorten(step), limits[:, 0], limits[:, 1])
        return None

    return solve


def _shorten(step: Array) -> Array:
    return step * min(1.0, LONGEST_STEP / max(float(np.abs(step).max()), 1e-9))


def measure(arm: str, poses: int) -> str:
    """Return the figures of an arm for as many random poses."""
    path = Path(catalogue.__file__).parent / "robots" / f"{arm}.xml"
    model = mujoco.MjModel.from_xml_path(str(path))
    chain, limits, draw = read_chain(model, "flange"), model.jnt_range.copy(), np.random.default_rng(1)
    low, high, rest = np.maximum(limits[:, 0], -np.pi), np.minimum(limits[:, 1], np.pi), limits.mean(axis=1)
    starts = np.concatenate([rest[None], spread_seeds(chain.slides, limits, rest, SEEDS)])

    def from_seeds(solve: Solve) -> Callable[[Pose], Array | None]:
        return lambda target: next((q for start in starts if (q := solve(target, start)) is not None), None)

    find_posture(chain, chain.place_tool(rest), limits, rest)
    ways: dict[str, Callable[[Pose], Array | None]] = {
        "skillc": lambda target: find_posture(chain, target, limits, rest),
        "mink": from_seeds(solve_with_mink(model)),
        "pinocchio": from_seeds(solve_with_pinocchio(path, chain, limits)),
    }
    times: dict[str, list[float]] = {name: [] for name in ways}
    solved = dict.fromkeys(ways, 0)
    for _ in range(poses):
        target = chain.place_tool(draw.uniform(low, high))
        for name, find in ways.items():
            began = process_time()
            q = find(target)
            times[name].append(process_time() - began)
            solved[name] += q is not None and _is_there(chain, q, target, limits)
    own = times["skillc"]
    return "\n".join(
        f"{arm}, {name}: {solved[name]} of {poses} solved; time / skillc {median(each) / median(own):.1f} in the "
        f"median, {mean(each) / mean(own):.1f} in the mean ({1e3 * median(each):.3f}, {1e3 * mean(each):.3f} ms)"
        for name, each in times.items()
    )


def _is_there(chain: Chain, q: Array, target: Pose, limits: Array) -> bool:
    tool = chain.place_tool(q)
    away = np.linalg.norm(tool.position - target.position) + np.linalg.norm(log(target.rotation @ tool.rotation.T))
    return bool(away < 1e-3 and (q >= limits[:, 0] - 1e-6).all() and (q <= limits[:, 1] + 1e-6).all())


if __name__ == "__main__":
    for name in ARMS:
        print(measure(name, int(sys.argv[1]) if len(sys.argv) > 1 else 1000))
