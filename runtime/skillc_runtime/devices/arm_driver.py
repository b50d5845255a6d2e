"""What skills see of an arm: what it measures, its motions, its compliance. `control` drives arms in this way."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from typing import Protocol, TypeAlias

from skillc_runtime.devices.arm import ArmLimits
from skillc_runtime.motion.joint import JointTrajectory
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Overlay, Reference, Trajectory


class Infeasible(ValueError):
    """An arm cannot follow a motion: `problem` names the joint or the distance, `place` (3,) m is in the arm's base."""

    def __init__(self, problem: str, place: Array) -> None:
        x, y, z = place
        super().__init__(f"at ({x:.3f}, {y:.3f}, {z:.3f}) m from the arm's base {problem}")
        self.problem, self.place = problem, place


@dataclass(frozen=True, slots=True)
class TaskLimits:
    """What skills may ask an arm for: force N, speed m/s, acceleration m/s^2 of its tool, jerk m/s^3 of its motions."""

    force_n: float
    speed_m_s: float
    acceleration_m_s2: float
    jerk_m_s3: float = inf


@dataclass(frozen=True, slots=True)
class Contact:
    """Something pushes back with more than `force_n` N for `for_s` s, once the tool approaches steadily."""

    force_n: float = 2.0
    for_s: float = 0.005


@dataclass(frozen=True, slots=True)
class Standstill:
    """A tool stays below a share of its approach speed for `for_s` s; `from_start_s` where it never got going."""

    share: float = 1 / 3
    for_s: float = 0.02
    from_start_s: float = 0.5


@dataclass(frozen=True, slots=True)
class Travel:
    """The tool has gone farther than `distance_m` m."""

    distance_m: float


StopCondition: TypeAlias = Contact | Standstill | Travel
"""What ends a phase of a motion; evaluated once a control period, so that no skill has to run there."""


@dataclass(frozen=True, slots=True)
class GuardedPush:
    """Approach what lies opposite to `along`, a unit vector (3,) in the world, and press on it with `force_n` N.

    It is touched when any of some conditions is met; where it gives way later, the tool approaches again. The arm stops
    where nothing is met within the travel, and where the tool sinks by as much after it was touched.
    """

    along: Array
    force_n: float
    approach_m_s: float
    travel: Travel
    touch_conditions: tuple[Contact | Standstill, ...] = (Standstill(), Contact())


class PushProgress(Protocol):
    """A guarded push under way."""

    @property
    def has_touched(self) -> bool:
        """Whether something has been met."""
        ...


class ArmMeasurements(Protocol):
    """What an arm measured last, in world axes; arrays are copies."""

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
        """What the environment does to the tool (6,), N and N m; measured at the wrist, else estimated."""
        ...

    @property
    def q(self) -> Array:
        """The joints (nv,) in rad."""
        ...

    def at_joints(self, q: Array) -> bool:
        """Tell whether the joints are at q (nv,) in rad."""
        ...

    def in_world(self, point: Array) -> Array:
        """Return a point (3,) in m of the arm's base frame in the world."""
        ...


class MotionInterface(Protocol):
    """Moves the tool or the joints; poses, directions and axes are of the world, so arms on a driving base come along.

    A new motion starts where the one before it comes to rest, never at the measured pose.
    """

    @property
    def reference(self) -> Reference:
        """Where the tool shall be, in the world, as of the last control period."""
        ...

    @property
    def path(self) -> Reference:
        """The same without overlays."""
        ...

    @property
    def done(self) -> bool:
        """Whether the reference rests, overlays aside."""
        ...

    @property
    def tracking_error_message(self) -> str | None:
        """How far the arm is from its reference along what it is to hold, in words; None when near enough."""
        ...

    def stopping_pose(self) -> Pose:
        """Return where a new motion of the tool starts, in the world; the arm moves its tool from now on."""
        ...

    def stopping_joints(self) -> Array:
        """Return where a new motion of the joints starts, (nv,) in rad; asking changes nothing."""
        ...

    def move_along(self, trajectory: Trajectory) -> None:
        """Move the tool along a trajectory in the world, more slowly where a joint would be too fast.

        ValueError where it does not start at `stopping_pose`; Infeasible where the arm cannot follow.
        """
        ...

    def joint_motion(self, way: Sequence[Array], share: float, blend: float = 0.0) -> JointTrajectory:
        """Return the motion of the joints from where they come to rest through all of `way`, each (nv,) in rad.

        share: of their greatest speeds, above 0 to 1. Postures on the way are passed without a stop if `blend` > 0, to
        1 at most.
        """
        ...

    def move_joints(self, goal: Array, share: float) -> None:
        """Move the joints to `goal` (nv,) in rad; `share` as for `joint_motion`."""
        ...

    def follow_joints(self, motion: JointTrajectory) -> None:
        """Move the joints along a motion, which must start at `stopping_joints`, else ValueError."""
        ...

    def stop(self) -> None:
        """Come to rest within the acceleration limit; compliance, push and overlays stay."""
        ...

    def pause(self) -> None:
        """Slow down to a standstill on the way."""
        ...

    def resume(self) -> None:
        """Go on where `pause` stopped."""
        ...

    def add_overlay(self, overlay: Overlay, axes: Array, fade: float) -> int:
        """Add a motion along `axes` (3, 3), columns in the world, growing for `fade` s; return its handle.

        Infeasible where a joint would be too fast.
        """
        ...

    def remove_overlay(self, handle: int) -> None:
        """Let an overlay fade out."""
        ...

    def inverse_kinematics(self, target: Pose, seed: Array) -> Array | None:
        """Return joints (nv,) in rad, near `seed`, that put the tool at a pose of the world; None if there are none."""
        ...


class ComplianceInterface(Protocol):
    """Lets the tool yield, and pushes with it; directions (3,) are unit vectors in the world."""

    @property
    def commanded_stiffness(self) -> Array:
        """The stiffness (6,) that skills want along the axes of the compliance frame, N/m and N m/rad."""
        ...

    def release(self, axis: Array, stiffness: float = 0.0) -> None:
        """Let the tool yield along a direction with a stiffness in N/m.

        Nested releases must be parallel or at right angles to the first, else ValueError.
        """
        ...

    def restore(self) -> None:
        """Undo the last release: hold the tool, along what it has yielded, where it is now. Gives up a motion."""
        ...

    def yields_along(self, axis: Array) -> bool:
        """Tell whether the tool was released along a direction."""
        ...

    def release_rotation(self) -> None:
        """Let the tool turn about the two axes across the released one."""
        ...

    def restore_rotation(self) -> None:
        """Hold the tool in the rotation that it has now. Gives up a motion."""
        ...

    def push(self, axis: Array, force_n: float, fastest_m_s: float = inf) -> None:
        """Press against what lies opposite to a direction, along which the tool must yield; else ValueError."""
        ...

    def push_off(self) -> None:
        """Let the push fade."""
        ...

    def start_push(self, push: GuardedPush) -> PushProgress:
        """Begin to approach and then to press; what is returned says how far it is."""
        ...

    def end_push(self, push: PushProgress) -> None:
        """Stop pushing."""
        ...


class ArmDriver(Protocol):
    """One arm under control. An arm that stops by itself says why in a fault, which whoever moves it takes."""

    @property
    def limits(self) -> ArmLimits:
        """What the joints can do."""
        ...

    @property
    def task_limits(self) -> TaskLimits:
        """What skills may ask for."""
        ...

    @property
    def measured(self) -> ArmMeasurements:
        """What the arm measured last."""
        ...

    @property
    def motion(self) -> MotionInterface:
        """What moves the arm."""
        ...

    @property
    def compliance(self) -> ComplianceInterface:
        """What lets the arm yield and push."""
        ...

    def take_fault(self) -> str | None:
        """Return why the arm stopped by itself, once; None while it has not."""
        ...
