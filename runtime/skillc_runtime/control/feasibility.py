"""Checks, before anything moves, whether an arm can follow a motion of its tool, and slows it down if necessary."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
import numpy as np

from skillc_runtime.control.inverse_kinematics import pose_error, step_towards
from skillc_runtime.control.laws.virtual_arm import VirtualArm
from skillc_runtime.devices.arm import ArmLimits
from skillc_runtime.devices.arm_driver import Infeasible
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Overlay, Reference, Trajectory

SAMPLE_S, MAX_SAMPLES = 0.05, 150
"""Time between samples of a motion, and their greatest number."""

STEPS, MOST_STEPS = 3, 30
"""Steps of inverse kinematics at each sample, from the solution of the sample before; the greater number if few do not
bring the tool near.

More are needed where a tool that is pressed starts: its reference may be several cm from it, in the air.
"""

MAX_POSITION_ERROR_M, MAX_ROTATION_ERROR_RAD = 0.003, 0.03
"""With a greater error of the tool a pose counts as out of reach."""

OVERLAY_S, OVERLAY_SAMPLES = 10.0, 400
"""Time over which an overlay is sampled, and the number of samples."""

RANGE_TOLERANCE_RAD = 0.01
"""How far beyond its range a joint may be: the law limits it."""

PULL = 0.05
"""Share of the distance to its first posture that a redundant arm moves in each step, as its law does."""


def slow_to_feasible(
    arm: VirtualArm, trajectory: Trajectory, q: Array, limits: ArmLimits
) -> tuple[Trajectory, list[Array]]:
    """Return a motion of the tool in the arm's base frame, slowed down if a joint would be too fast.

    Also return the joints (nv,) in rad at samples of it; q (nv,) are those at its start. Raises Infeasible if a joint
    would leave its range or the tool cannot follow.
    """
    before, fastest, joints = q, 1.0, list[Array]()
    for step, after in joints_along(arm, trajectory, q, limits):
        fastest = max(fastest, float((np.abs(after - before) / (limits.velocity * step)).max()))
        before = after
        joints.append(after)
    return slow_down(trajectory, fastest), joints


def joints_along(arm: VirtualArm, trajectory: Trajectory, q: Array, limits: ArmLimits) -> Iterator[tuple[float, Array]]:
    """Yield the joints (nv,) in rad at samples of a motion of the tool in base, and the time in s since the one before.

    q (nv,): rad, at its start. Raises Infeasible if a joint would leave its range or the tool cannot follow.
    """
    count = int(np.clip(np.ceil(trajectory.duration / SAMPLE_S), 1, MAX_SAMPLES))
    times, first = np.linspace(0.0, trajectory.duration, count + 1), q
    for time, step in zip(times[1:].tolist(), np.diff(times).tolist(), strict=True):
        target = trajectory.at(time).pose
        q, error = _track(arm, target, q, first)
        _check(arm, target, q, error, limits)
        yield step, q


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


def _track(arm: VirtualArm, target: Pose, q: Array, first: Array) -> tuple[Array, Array]:
    """Return joints (nv,) in rad after steps from q towards a target pose of the tool; and its error (6,) in m, rad."""
    few: tuple[Array, Array] | None = None
    error = _find_error(arm, target, q)
    for number in range(1, MOST_STEPS + 1):
        q = q + step_towards(arm.jacobian, error, PULL * (first - q))
        error = _find_error(arm, target, q)
        if number >= STEPS and _is_near(error):
            return q, error
        if number == STEPS:
            few = q, error
    assert few is not None, "there are more steps than STEPS"
    return few


def _find_error(arm: VirtualArm, target: Pose, q: Array) -> Array:
    arm.update_kinematics(q)
    return pose_error(arm.tool, target)


def _is_near(error: Array) -> bool:
    away, turned = np.linalg.norm(error[:3]), np.linalg.norm(error[3:])
    return bool(away <= MAX_POSITION_ERROR_M and turned <= MAX_ROTATION_ERROR_RAD)


def _check(arm: VirtualArm, target: Pose, q: Array, error: Array, limits: ArmLimits) -> None:
    outside = np.maximum(limits.range[:, 0] - q, q - limits.range[:, 1])
    if outside.max() > RANGE_TOLERANCE_RAD:
        joint = int(outside.argmax())
        low, high = limits.range[joint]
        raise Infeasible(
            f"{arm.joint_name(joint)} would have to be at {q[joint]:.2f} {arm.joint_unit(joint)}, "
            f"outside its range from {low:.2f} to {high:.2f} {arm.joint_unit(joint)}",
            target.position,
        )
    if not _is_near(error):
        away, turned = float(np.linalg.norm(error[:3])), float(np.linalg.norm(error[3:]))
        raise Infeasible(
            f"its tool would be {1000 * away:.0f} mm and {np.degrees(turned):.0f} deg away from where it shall be",
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
