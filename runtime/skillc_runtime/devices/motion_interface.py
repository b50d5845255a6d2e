"""How the motion of an arm is planned and commanded."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

import msgspec

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
