"""The interface of an arm for skills: measurements, motion and compliance. `control` implements it."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf
from typing import TYPE_CHECKING, Protocol

import msgspec

from skillc_runtime.devices.arm import ArmLimits
from skillc_runtime.devices.guarded_push import GuardedPush, PushProgress

if TYPE_CHECKING:
    # Compiled functions are slow to import, and whoever only reads gains needs none.
    from skillc_runtime.motion.paths.joint import JointTrajectory
    from skillc_runtime.motion.pose import Array, Pose
    from skillc_runtime.motion.reference import Overlay, Reference, Trajectory


class Infeasible(ValueError):
    """An arm cannot follow a motion: `problem` names the joint or the distance, `place` (3,) m is in the base frame."""

    def __init__(self, problem: str, place: Array) -> None:
        x, y, z = place
        super().__init__(f"at ({x:.3f}, {y:.3f}, {z:.3f}) m from the arm's base {problem}")
        self.problem, self.place = problem, place

    def __reduce__(self) -> tuple[type[Infeasible], tuple[str, Array]]:
        return Infeasible, (self.problem, self.place)


class TaskLimits(msgspec.Struct, frozen=True):
    """Limits of skills: force N, speed m/s and acceleration m/s^2 of the tool, jerk m/s^3 of motions."""

    force_n: float
    speed_m_s: float
    acceleration_m_s2: float
    jerk_m_s3: float = inf


class ArmMeasurements(Protocol):
    """The last measurement of an arm, in world axes; arrays are copies."""

    @property
    def pose(self) -> Pose:
        """The tool centre point in the world."""
        ...

    @property
    def velocity(self) -> Array:
        """The twist (6,) of the tool, [linear m/s; angular rad/s]."""
        ...

    @property
    def wrench(self) -> Array:
        """The wrench (6,) of the environment on the tool, N and N m: `felt`, or what the arm is to exert without it."""
        ...

    @property
    def pressing_n(self) -> float:
        """The force in N with which the tool presses along its axis, by `wrench`."""
        ...

    @property
    def felt(self) -> Array | None:
        """The wrench (6,) that a sensor or the torques of the joints measure, N and N m; None if nothing does."""
        ...

    @property
    def q(self) -> Array:
        """The joints (nv,) in rad."""
        ...

    @property
    def still(self) -> bool:
        """Whether all joints are at rest."""
        ...

    def at_joints(self, q: Array) -> bool:
        """Tell whether the joints are at q (nv,) in rad."""
        ...

    def in_world(self, point: Array) -> Array:
        """Return a point (3,) in m of the arm's base frame in the world frame."""
        ...


class ToolMotion(msgspec.Struct, frozen=True):
    """A motion of the tool, in the arm's base frame, that the arm can follow.

    start (nv,), joints: rad, the joints at its start, and at samples of it.
    """

    in_base: Trajectory
    start: Array
    joints: list[Array]


class MotionModel(Protocol):
    """The motions that an arm can make from where it is at one instant; copied, it works in another process."""

    @property
    def start(self) -> Array:
        """The joints (nv,) in rad where a new motion of the joints starts."""
        ...

    def rank_postures(self, target: Pose, rest: Array) -> Array:
        """Return postures (n, nv) in rad with the tool at `target` in the world, the best first: near `rest` (nv,)."""
        ...

    def inverse_kinematics(self, target: Pose, seed: Array) -> Array | None:
        """Return joints (nv,) in rad, near `seed`, with the tool at `target` in the world; None if there are none."""
        ...

    def joint_motion(self, way: Sequence[Array], share: float, blend: float = 0.0) -> JointTrajectory:
        """Return the motion of the joints from where they come to rest.

        Infeasible if the tool would leave its workspace.
        way: postures, each (nv,) in rad.
        share: above 0 to 1, the share of the greatest joint speeds.
        blend: share, 0 to 1, of the possible overlap at each intermediate posture; the motion stops there at 0.
        """
        ...

    def tool_motion(self, trajectory: Trajectory) -> ToolMotion:
        """Return the motion of the tool along a trajectory in the world; Infeasible if the arm cannot follow it.

        It is slowed down if a joint would be too fast.
        """
        ...


class MotionInterface(Protocol):
    """Moves the tool or the joints. Poses, directions and axes are in the world, so the base of an arm may move.

    A new motion starts where the one before it comes to rest, never at the measured pose.
    """

    @property
    def reference(self) -> Reference:
        """The reference of the tool in the world, of the last control period."""
        ...

    @property
    def path_velocity(self) -> Array:
        """The velocity (3,) in m/s of the tool in the world, of its reference without overlays."""
        ...

    @property
    def done(self) -> bool:
        """Whether the reference without overlays is at rest."""
        ...

    @property
    def stationary(self) -> bool:
        """Whether the reference stands still: its motion has ended and no overlay is left, or they are paused."""
        ...

    @property
    def tracking_error_message(self) -> str | None:
        """A message about the error of the arm along stiff axes; None if it is small."""
        ...

    def stopping_pose(self) -> Pose:
        """Return the pose in the world where a new motion of the tool starts; switches the arm to tool control."""
        ...

    def stopping_joints(self) -> Array:
        """Return the joints (nv,) in rad where a new motion of the joints starts; nothing changes."""
        ...

    def move_along(self, trajectory: Trajectory) -> None:
        """Move the tool along a trajectory in the world, slowed down if a joint would be too fast.

        Raises ValueError if it does not start at `stopping_pose`, Infeasible if the arm cannot follow it.
        """
        ...

    def model(self) -> MotionModel:
        """Return the motions that the arm can make from where it is now, to be computed without it."""
        ...

    def follow_tool(self, motion: ToolMotion) -> None:
        """Move the tool as the model has computed; ValueError if the motion does not start at `stopping_pose`."""
        ...

    def move_joints(self, goal: Array, share: float) -> None:
        """Move the joints to `goal` (nv,) in rad; `share` as for `joint_motion` of the model."""
        ...

    def follow_joints(self, motion: JointTrajectory) -> None:
        """Move the joints as the model has computed; ValueError if the motion does not start at `stopping_joints`."""
        ...

    def stop(self) -> None:
        """Come to rest within the acceleration limit; compliance, push and overlays are kept."""
        ...

    def pause(self) -> None:
        """Slow down to a standstill along the motion."""
        ...

    def resume(self) -> None:
        """Continue after `pause`."""
        ...

    def add_overlay(self, overlay: Overlay, axes: Array, fade: float) -> int:
        """Add an overlay along `axes` (3, 3), columns in the world, which fades in for `fade` s; return its handle.

        Raises Infeasible if a joint would be too fast, or the tool would leave its workspace.
        """
        ...

    def remove_overlay(self, handle: int) -> None:
        """Fade an overlay out."""
        ...

    def inverse_kinematics(self, target: Pose, seed: Array) -> Array | None:
        """Return joints (nv,) in rad, near `seed`, with the tool at `target` in the world; None if there are none."""
        ...


class ComplianceInterface(Protocol):
    """Releases axes of the tool and pushes with it; directions (3,) are unit vectors in the world."""

    @property
    def commanded_stiffness(self) -> Array:
        """The commanded stiffness (6,) along the axes of the compliance frame, N/m and N m/rad."""
        ...

    @property
    def commanded_force(self) -> Array:
        """The force (3,) N on the tool by what it presses on, world axes, that is commanded now; NaN without a push."""
        ...

    def tare(self) -> bool:
        """Let what the force sensor, if there is one, feels of nothing be 0, before the tool yields, at rest.

        Return whether nothing is left to be waited for; call it again in the next tick else.
        """
        ...

    @property
    def tares(self) -> bool:
        """Whether the arm feels forces that `tare` lets be 0."""
        ...

    def retare(self) -> bool:
        """Take the tool off what it presses on, tare there, and press again, along the axes that were released before.

        Return whether it presses as long as a force needs to settle, or presses on nothing; call it in each tick until
        then.
        """
        ...

    def release(self, axis: Array, stiffness: float = 0.0) -> None:
        """Release a direction `axis` (3,), with a remaining stiffness in N/m.

        Raises ValueError for a nested release that is neither parallel nor perpendicular to the first.
        """
        ...

    def restore(self) -> None:
        """Undo the last release: hold the tool, along the released axis, where it is now. Abandons a motion."""
        ...

    @property
    def released(self) -> bool:
        """Whether any direction is released."""
        ...

    def yields_along(self, axis: Array) -> bool:
        """Tell whether a direction `axis` (3,) is released."""
        ...

    def release_rotation(self) -> None:
        """Release the rotations about the two axes perpendicular to the released one."""
        ...

    def restore_rotation(self) -> None:
        """Hold the present rotation of the tool. Abandons a motion."""
        ...

    def push(self, axis: Array, force_n: float, fastest_m_s: float = inf) -> None:
        """Push opposite to a direction, which must be released; ValueError if it is not.

        axis: (3,), a unit vector in the world.
        force_n: N.
        fastest_m_s: m/s, of the tool in the direction of the push.
        """
        ...

    def push_off(self) -> None:
        """Fade the push out."""
        ...

    def start_push(self, push: GuardedPush) -> PushProgress:
        """Begin to approach and then to push; the result gives the progress."""
        ...

    def end_push(self, push: PushProgress) -> None:
        """Stop pushing."""
        ...

    def pause(self) -> None:
        """Hold the tool along released directions, unless a push is in contact.

        If that push loses contact, the tool is held then. Motions are not concerned; they have a pause of their own.
        """
        ...

    def withdraw(self, push: PushProgress) -> None:
        """Take the tool off what it presses on, with its approach speed, and hold it there."""
        ...

    def resume(self) -> None:
        """Yield again as before `pause` or `withdraw`; a push that was held approaches again.

        While the tool is still being taken off, this does nothing; it is to be called again.
        """
        ...


class ArmDriver(Protocol):
    """One arm under control. If an arm stops by itself, `take_fault` returns the reason."""

    @property
    def limits(self) -> ArmLimits:
        """The limits of the joints."""
        ...

    @property
    def task_limits(self) -> TaskLimits:
        """The limits of skills."""
        ...

    @property
    def measured(self) -> ArmMeasurements:
        """The last measurement."""
        ...

    @property
    def motion(self) -> MotionInterface:
        """The motion of tool and joints."""
        ...

    @property
    def compliance(self) -> ComplianceInterface:
        """The compliance and push of the tool."""
        ...

    @property
    def speed(self) -> float:
        """The share, above 0 to 1, of their speeds that motions, overlays and approaches have."""
        ...

    def set_speed(self, share: float) -> None:
        """Let motions, overlays and approaches have this share of their speeds from now on; forces stay as they are.

        What the motion is stays the same: it takes its time divided by the share.
        """
        ...

    def take_fault(self) -> str | None:
        """Return why the arm stopped by itself, once; None if it did not."""
        ...
