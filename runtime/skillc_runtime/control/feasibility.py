"""Checks, before anything moves, whether an arm can follow a motion of its tool, and slows it down if necessary."""

from __future__ import annotations

import msgspec
import numpy as np

from skillc_runtime.control.laws.virtual_arm import VirtualArm
from skillc_runtime.devices.arm import ArmLimits
from skillc_runtime.devices.motion_interface import Infeasible
from skillc_runtime.kinematics.chain import pack
from skillc_runtime.kinematics.sweep import ERROR_M, ERROR_RAD, FAR_M, FAR_RAD, MARGIN, JointLoad, follow
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Overlay, Reference, Trajectory

SAMPLE_S, MAX_SAMPLES = 0.05, 150
"""Time between samples of a motion, and their greatest number."""

OVERLAY_S, OVERLAY_SAMPLES = 10.0, 400
"""Time over which an overlay is sampled, and the number of samples."""

RANGE_TOLERANCE_RAD = 0.01
"""How far beyond its range a joint may be: the law limits it."""


def slow_to_feasible(
    arm: VirtualArm, trajectory: Trajectory, q: Array, limits: ArmLimits
) -> tuple[Trajectory, list[Array]]:
    """Return a motion of the tool in the arm's base frame, slowed down if a joint would be too fast.

    Also return the joints (nv,) in rad at samples of it; q (nv,) are those at its start. Raises Infeasible if a joint
    would leave its range or the tool cannot follow.
    """
    joints, step = follow_trajectory(arm, trajectory, q, limits)
    changes = np.abs(np.diff([q, *joints], axis=0))
    return slow_down(trajectory, float((changes / (limits.velocity * step)).max())), joints


def follow_trajectory(
    arm: VirtualArm, trajectory: Trajectory, q: Array, limits: ArmLimits
) -> tuple[list[Array], float]:
    """Return the joints (nv,) in rad at samples of a motion of the tool in base, and the time in s between samples.

    q (nv,): rad, at its start. Raises Infeasible if a joint would leave its range or the tool cannot follow.
    """
    count = int(np.clip(np.ceil(trajectory.duration / SAMPLE_S), 1, MAX_SAMPLES))
    targets = [trajectory.at(time).pose for time in np.linspace(0.0, trajectory.duration, count + 1)[1:].tolist()]
    load = JointLoad(limits.range, np.full(len(q), np.inf), np.zeros(3), np.zeros(3))
    sweep = follow(arm.read_chain(), np.array([pack(each) for each in targets]), q, load)
    for target, posture, measures in zip(targets, sweep.postures, sweep.measures, strict=True):
        _check(arm, target, posture, measures, limits)
    return list(sweep.postures), trajectory.duration / count


def sample_offsets(overlay: Overlay) -> list[Array]:
    """Return the displacements (3,), m, along the axes of an overlay in its first `OVERLAY_S`."""
    return [overlay.at(float(time))[0] for time in np.linspace(0.0, OVERLAY_S, OVERLAY_SAMPLES)]


def check_overlay_feasible(arm: VirtualArm, overlay: Overlay, axes: Array, limits: ArmLimits) -> None:
    """Raise Infeasible if a joint would be too fast for an overlay along `axes` (3, 3) in base in the present posture.

    dq = J^+ [v; 0] for the velocities v of the overlay, m/s, in its first `OVERLAY_S`.
    """
    velocities = np.array([overlay.at(float(time))[1] for time in np.linspace(0.0, OVERLAY_S, OVERLAY_SAMPLES)])
    speeds = np.abs(np.linalg.pinv(arm.jacobian)[:, :3] @ axes @ velocities.T).max(axis=1)
    joint = int((speeds / limits.velocity).argmax())
    if speeds[joint] > limits.velocity[joint]:
        raise Infeasible(
            f"{arm.joint_name(joint)} would have to move with {speeds[joint]:.2f} {arm.joint_unit(joint)}/s, "
            f"faster than the {limits.velocity[joint]:.2f} {arm.joint_unit(joint)}/s it can",
            arm.tool.position,
        )


def _check(arm: VirtualArm, target: Pose, q: Array, measures: Array, limits: ArmLimits) -> None:
    """Raise Infeasible if joints q (nv,) do not bring the tool to a pose in base; measures (4,): as of `Sweep`."""
    if measures[ERROR_M] > FAR_M or measures[ERROR_RAD] > FAR_RAD:
        away, turned = 1000 * measures[ERROR_M], np.degrees(measures[ERROR_RAD])
        raise Infeasible(
            f"its tool would be {away:.0f} mm and {turned:.0f} deg away from where it shall be", target.position
        )
    if measures[MARGIN] < -RANGE_TOLERANCE_RAD:
        joint = int(np.maximum(limits.range[:, 0] - q, q - limits.range[:, 1]).argmax())
        low, high = limits.range[joint]
        raise Infeasible(
            f"{arm.joint_name(joint)} would have to be at {q[joint]:.2f} {arm.joint_unit(joint)}, "
            f"outside its range from {low:.2f} to {high:.2f} {arm.joint_unit(joint)}",
            target.position,
        )


class SlowedTrajectory(msgspec.Struct, frozen=True):
    """A trajectory that takes `factor` >= 1 times as long, along the same path in the same frame."""

    trajectory: Trajectory
    factor: float

    @property
    def tabled(self) -> tuple[Array, float] | None:
        """The table (n, 35) of the path, for `reference_plan`, and the factor by which it is slower, or None."""
        found: tuple[Array, float] | None = getattr(self.trajectory, "tabled", None)
        return None if found is None else (found[0], found[1] * self.factor)

    @property
    def duration(self) -> float:
        """The time in s from start to rest."""
        return self.trajectory.duration * self.factor

    def at(self, time: float) -> Reference:
        """Return the reference `time` s after the start."""
        fast = self.trajectory.at(time / self.factor)
        return Reference.of(fast.pose, fast.twist / self.factor, fast.acceleration / self.factor**2)

    def transform(self, frame: Pose) -> SlowedTrajectory:
        """Return the same motion in the parent frame of `frame`."""
        return SlowedTrajectory(self.trajectory.transform(frame), self.factor)


def slow_down(trajectory: Trajectory, factor: float) -> Trajectory:
    """Return a trajectory that is slower by a factor, or the same if the factor is at most 1."""
    return SlowedTrajectory(trajectory, factor) if factor > 1 else trajectory
