"""The true state of a cell, which only a simulation knows: for reports and trials, never for skills."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import msgspec
import numpy as np

from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.pose import Array, Pose


class Recording(msgspec.Struct, frozen=True):
    """A time interval of a run, one row a simulation step, read-only. True values in the world frame, SI units.

    force (n,): N, normal force of all contacts of the tool's working face. position (n, 3), quaternion (n, 4),
    velocity (n, 3): of the centre of that face, z out of the tool. reference, reference_velocity (n, 3): of the arm's
    controller, NaN while it controls joints; path, path_velocity (n, 3): the same without overlays. on_surface (n,): N,
    the part of the force that presses on a surface itself, and not on an object on it. rows (n, 25): all columns.
    """

    rows: Array

    @property
    def time(self) -> Array:
        """The time (n,) in s since the cell started."""
        return self.rows[:, 0]

    @property
    def force(self) -> Array:
        """Normal force (n,) in N."""
        return self.rows[:, 1]

    @property
    def position(self) -> Array:
        """Position of the working face (n, 3) in m."""
        return self.rows[:, 2:5]

    @property
    def quaternion(self) -> Array:
        """Orientation of the working face as unit quaternions (n, 4), (w, x, y, z)."""
        return self.rows[:, 5:9]

    @property
    def velocity(self) -> Array:
        """Velocity of the working face (n, 3) in m/s."""
        return self.rows[:, 9:12]

    @property
    def reference(self) -> Array:
        """Reference position of the controller (n, 3) in m."""
        return self.rows[:, 12:15]

    @property
    def reference_velocity(self) -> Array:
        """Reference velocity of the controller (n, 3) in m/s."""
        return self.rows[:, 15:18]

    @property
    def path(self) -> Array:
        """Reference position without overlays (n, 3) in m."""
        return self.rows[:, 18:21]

    @property
    def path_velocity(self) -> Array:
        """Reference velocity without overlays (n, 3) in m/s."""
        return self.rows[:, 21:24]

    @property
    def on_surface(self) -> Array:
        """Normal force on a surface itself (n,) in N."""
        return self.rows[:, 24]

    def between(self, start: float, end: float) -> Recording:
        """Return the rows with start <= time < end, in s."""
        first, last = np.searchsorted(self.time, (start, end))
        return Recording(self.rows[first:last])

    def without(self, intervals: Sequence[tuple[float, float]]) -> Recording:
        """Return the rows before the end of the last of some intervals, in s, that are in none of them."""
        wanted = self.time < max(end for _, end in intervals)
        for start, end in intervals:
            wanted &= (self.time < start) | (self.time >= end)
        return Recording(self.rows[wanted])


def join_recordings(intervals: Sequence[Recording]) -> Recording:
    """Return the rows of several recordings, one after the other."""
    return intervals[0] if len(intervals) == 1 else Recording(np.concatenate([each.rows for each in intervals]))


class Guidance(msgspec.Struct, frozen=True):
    """How a person guided a tool: the intended place (3,) of its centre point, m in the world, and forces (n,) in N.

    There is a force, and its time in s, for each simulation step in which they guided it; `arm` holds the tool.
    """

    place: Array
    forces: Array
    times: Array
    arm: str


class Touching(msgspec.Struct, frozen=True):
    """A contact of a part of a robot, or of what it holds, that is neither a grasp nor its tool's work.

    part, other: what touched what, by short names; start_s, end_s: s; peak_force_n: N, None where it is not computed.
    """

    part: str
    other: str
    start_s: float
    end_s: float
    peak_force_n: float | None


class HandSample(msgspec.Struct, frozen=True):
    """A gripper at one instant: its tool centre point (3,) in m in the world, and how far its fingers are apart in m.

    finger_force_n: N, with which each finger presses; while something is held, that with which it was grasped. None
    where forces are not computed. measured_m: the opening that skills read last, with the errors of the sensor; None
    before the first reading.
    """

    position: Array
    opening_m: float
    finger_force_n: float | None
    measured_m: float | None


class GroundTruth(Protocol):
    """The true state of a cell; objects are named by IRI. `Cell` does not offer it, so primitives have no access."""

    @property
    def seed(self) -> int:
        """The seed of the differences between reality and world model."""
        ...

    @property
    def variation(self) -> str:
        """How reality differed from the world model at the start, as text; empty if it did not."""
        ...

    def recording(self, tool: str) -> Recording:
        """Return the recording of a tool while it was held; KeyError if the cell has no such tool."""
        ...

    def peak_force_n(self, tool: str) -> float:
        """Return the greatest force on a tool while it was held; KeyError if the cell has no such tool."""
        ...

    def mean_force_n(self, tool: str, since: float) -> float:
        """Return the mean normal force in N of the contacts of a tool's working face from `since` in s on.

        It is 0 while the tool is not held. KeyError if the cell has no such tool.
        """
        ...

    def surface_pose(self, surface: str) -> Pose:
        """Return the true pose of a surface in the world; KeyError if the cell has no such surface."""
        ...

    def is_present(self, surface: str) -> bool:
        """Whether a surface really is there; KeyError if the cell has no such surface."""
        ...

    def coverage(self, surface: str) -> CoverageMap:
        """Return where and how long tools have worked on a surface; KeyError if the cell has no such surface."""
        ...

    def fixture_pose(self, fixture: str) -> Pose:
        """Return the true pose of a fixture in the world; KeyError if the cell has no such fixture."""
        ...

    def face_position(self, tool: str) -> Array:
        """Return where the middle (3,) of a tool's working face is, in m in the world; KeyError for an unknown tool."""
        ...

    def body_pose(self, individual: str) -> Pose:
        """Return the true pose of a tool or a body in the world; KeyError if the cell has no such thing."""
        ...

    def carried_by(self, gripper: str) -> str | None:
        """Return what is really in a gripper, None if nothing is; KeyError if the cell has no such gripper."""
        ...

    def hand(self, gripper: str) -> HandSample:
        """Return where a gripper really is and how it grips; KeyError if the cell has no such gripper."""
        ...

    def contact_force(self, gripper: str) -> Array | None:
        """Return the force (3,) in N, world axes, with which a hand and what it holds press on the rest, added up.

        It is the sum of all contacts. None where forces are not computed; KeyError if the cell has no such gripper.
        """
        ...

    def pressing(self, button: str) -> Array:
        """Return the steps (n, 3) with a force on a button: time in s, force in N, 1 if switched, else 0.

        The force is the normal one on its cap, whatever the frame.

        KeyError if the cell has no such button.
        """
        ...

    def contacts(self) -> Sequence[Touching]:
        """Return what links, hands, bases and the rigid parts of held objects have touched, in order of time."""
        ...

    def guidances(self) -> Sequence[Guidance]:
        """Return how people guided tools by hand, in order of IRI; people who guided none are left out."""
        ...
