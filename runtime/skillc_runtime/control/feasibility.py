"""Whether an arm can follow a motion of its tool, found out before anything moves."""

from __future__ import annotations

import numpy as np

from skillc_runtime.control.inverse_kinematics import pose_error, step_towards
from skillc_runtime.control.virtual_arm import VirtualArm
from skillc_runtime.devices.arm import ArmLimits
from skillc_runtime.devices.arm_driver import Infeasible
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Overlay, Trajectory
from skillc_runtime.motion.slowed_trajectory import slow_down

SAMPLE_S, MAX_SAMPLES = 0.05, 150
"""How closely a motion is looked at."""

STEPS = 3
"""Steps of inverse kinematics at each sample; the one before is near."""

MAX_POSITION_ERROR_M, MAX_ROTATION_ERROR_RAD = 0.003, 0.03
"""A tool that stays farther than this from where it shall be cannot get there."""

OVERLAY_S, OVERLAY_SAMPLES = 10.0, 400
"""For how long, and how closely, an overlay is looked at."""

RANGE_TOLERANCE_RAD = 0.01
"""How far beyond its range a joint may seem to go: the law holds it back."""

PULL = 0.05
"""Share of the way back to its first posture that a redundant arm goes at each step, as its law pulls it there."""


def slow_to_feasible(arm: VirtualArm, trajectory: Trajectory, q: Array, limits: ArmLimits) -> Trajectory:
    """Return a motion of the tool in the arm's base frame, slowed down where a joint would be too fast.

    q (nv,) rad: where the joints are at its start. Infeasible where a joint would leave its range or the tool falls
    behind.
    """
    count = int(np.clip(np.ceil(trajectory.duration / SAMPLE_S), 1, MAX_SAMPLES))
    times, first, fastest = np.linspace(0.0, trajectory.duration, count + 1), q, 1.0
    for time, step in zip(times[1:], np.diff(times), strict=True):
        target, before = trajectory.at(float(time)).pose, q
        q = _followed(arm, target, q, first)
        _check(arm, target, q, limits)
        fastest = max(fastest, float((np.abs(q - before) / (limits.velocity * step)).max()))
    return slow_down(trajectory, fastest)


def check_overlay_feasible(arm: VirtualArm, overlay: Overlay, axes: Array, limits: ArmLimits) -> None:
    """Refuse an overlay along `axes` (3, 3) in base for which a joint would be too fast where the arm is: Infeasible.

    dq = J^+ [v; 0] for the overlay's velocities v in its first `OVERLAY_S`.
    """
    velocities = np.array([overlay.at(float(time))[1] for time in np.linspace(0.0, OVERLAY_S, OVERLAY_SAMPLES)])
    speeds = np.abs(np.linalg.pinv(arm.jacobian)[:, :3] @ axes @ velocities.T).max(axis=1)
    joint = int((speeds / limits.velocity).argmax())
    if speeds[joint] > limits.velocity[joint]:
        raise Infeasible(
            f"{arm.joint_name(joint)} would have to turn with {speeds[joint]:.2f} rad/s, faster than the "
            f"{limits.velocity[joint]:.2f} rad/s it can",
            arm.tool.position,
        )


def _followed(arm: VirtualArm, target: Pose, q: Array, first: Array) -> Array:
    """Return joints near q (nv,) that put the tool as near to its target as a few steps lead."""
    for _ in range(STEPS):
        arm.update_kinematics(q)
        q = q + step_towards(arm.jacobian, pose_error(arm.tool, target), PULL * (first - q))
    return q


def _check(arm: VirtualArm, target: Pose, q: Array, limits: ArmLimits) -> None:
    outside = np.maximum(limits.range[:, 0] - q, q - limits.range[:, 1])
    if outside.max() > RANGE_TOLERANCE_RAD:
        joint = int(outside.argmax())
        low, high = limits.range[joint]
        raise Infeasible(
            f"{arm.joint_name(joint)} would have to be at {q[joint]:.2f} rad, "
            f"outside its range from {low:.2f} to {high:.2f} rad",
            target.position,
        )
    arm.update_kinematics(q)
    error = pose_error(arm.tool, target)
    away, turned = float(np.linalg.norm(error[:3])), float(np.linalg.norm(error[3:]))
    if away > MAX_POSITION_ERROR_M or turned > MAX_ROTATION_ERROR_RAD:
        raise Infeasible(
            f"its tool would be {1000 * away:.0f} mm and {np.degrees(turned):.0f} deg away from where it shall be",
            target.position,
        )
