"""The interface of an arm for skills: measurements, motion and compliance. `control` implements it."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Protocol

import msgspec

from skillc_runtime.devices.arm import ArmLimits
from skillc_runtime.devices.guarded_push import GuardedPush, PushProgress
from skillc_runtime.devices.motion_interface import MotionInterface
from skillc_runtime.motion.arrays import Array

if TYPE_CHECKING:
    # Compiled functions are slow to import, and whoever only reads gains needs none.
    from skillc_runtime.motion.pose import Pose


class TaskLimits(msgspec.Struct, frozen=True):
    """Limits of skills: force N, speed m/s and acceleration m/s^2 of the tool, jerk m/s^3 of motions."""

    force_n: float
    speed_m_s: float
    acceleration_m_s2: float
    jerk_m_s3: float = inf


class LinkTorque(msgspec.Struct, frozen=True):
    """What torque sensors between gears and links tell, in N m.

    torque (nv,): by how much they differ from what carries the weight of arm and load, as the arm knows it: at rest,
    what the environment exerts, J^T W. own (nv,): what carries that weight. jacobian (6, nv): J of the tool, [linear m;
    angular rad] per rad, world axes.
    """

    torque: Array
    own: Array
    jacobian: Array


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
    def link_torque(self) -> LinkTorque | None:
        """What torque sensors between gears and links tell; None without them."""
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

    @property
    def force_drift(self) -> float:
        """How fast the force of the sensor was found to drift by its tares, in N/s, which is taken off; 0 without."""
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
