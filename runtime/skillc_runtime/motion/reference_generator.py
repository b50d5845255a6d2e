"""Where the tool shall be now: a trajectory, what is left of the motion before it, and overlays; all in one frame."""

from __future__ import annotations

import numpy as np

from skillc_runtime.motion.arrays import Matrix, OutMatrix
from skillc_runtime.motion.numerics.compiled import compiled
from skillc_runtime.motion.numerics.linear import product
from skillc_runtime.motion.overlays import FadedOverlay
from skillc_runtime.motion.pose import Array, Pose, exp, skew
from skillc_runtime.motion.reference import Overlay, Reference, Trajectory, resting_reference
from skillc_runtime.motion.stopping_motion import stopping_motion
from skillc_runtime.motion.time_scaling import TimeScaling

TURN_DECELERATION = 2.0
"""rad/s^2 with which a turn is stopped."""


class ReferenceGenerator:
    """The reference of one tool. A motion starts where the one before it comes to rest; the two overlap without a jump.

    Motion time starts with each motion, overlay time runs on; a pause slows both to a standstill. `path` is the last
    sample, overlays aside.
    """

    def __init__(self, pose: Pose, deceleration: float) -> None:
        """Hold a pose; motions that are given up stop with `deceleration` m/s^2."""
        self._deceleration = deceleration
        self._overlays: dict[int, tuple[FadedOverlay, Array]] = {}
        self._next_handle = 0
        self._overlay_time = TimeScaling()
        self.restart_from(pose, np.zeros(6), 0.0)

    def restart_from(self, pose: Pose, twist: Array, now: float) -> None:
        """Come to rest from a pose and a twist (6,), whatever was done before."""
        self._time, self._overlay_time = TimeScaling(since=now), self._overlay_time.towards(1.0, now)
        self._way, self._turn = (
            stopping_motion(twist[:3], self._deceleration),
            stopping_motion(twist[3:], TURN_DECELERATION),
        )
        self._rest = resting_reference(Pose(pose.position + self._way.way, exp(self._turn.way) @ pose.rotation))
        self._trajectory: Trajectory | None = None
        self._ends = max(self._way.duration, self._turn.duration)
        self.path = self._rest

    def follow(self, trajectory: Trajectory, now: float) -> None:
        """Follow a trajectory from now on; it must start at `stopping_pose`, else ValueError."""
        start, stopping = trajectory.at(0.0).pose, self.stopping_pose(now)
        far = float(np.abs(start.position - stopping.position).max())
        if far > 1e-3 or np.abs(start.rotation - stopping.rotation).max() > 1e-2:
            raise ValueError(
                f"a motion must start where the last one ends; this one starts {far * 1e3:.1f} mm beside it"
            )
        self.stop(now)
        self._trajectory = trajectory
        self._ends = max(self._ends, trajectory.duration)
        self._rest = resting_reference(trajectory.at(trajectory.duration).pose)

    def stop(self, now: float) -> None:
        """Give up the trajectory and come to rest."""
        motion = self._motion(now)
        self.restart_from(motion.pose, motion.twist, now)

    def jump_to(self, pose: Pose, along: Array, now: float) -> None:
        """Jump to a pose, and come to rest there; of the present motion only what is along the axes (3, n) goes on.

        For axes along which the tool does not follow its reference anyway. Overlays are not part of the pose.
        """
        twist = self._motion(now).twist.copy()
        twist[:3] = along @ (along.T @ twist[:3])
        self.restart_from(pose, twist, now)

    def path_pose(self, now: float) -> Pose:
        """Return where the reference is, overlays aside."""
        return self._motion(now).pose

    def stopping_pose(self, now: float) -> Pose:
        """Return where the reference, overlays aside, rests if it is stopped now: where a new motion must start."""
        motion = self._motion(now)
        way = stopping_motion(motion.twist[:3], self._deceleration).way
        turn = stopping_motion(motion.twist[3:], TURN_DECELERATION).way
        return Pose(motion.pose.position + way, exp(turn) @ motion.pose.rotation)

    def done(self, now: float) -> bool:
        """Tell whether the motion has run out and nothing is left of the one before it."""
        return self._time.at(now)[0] >= self._ends

    def at_rest(self, now: float) -> bool:
        """Tell whether the reference stands still: the motion is done and no overlay is left."""
        return self.done(now) and not self._overlays

    def pause(self, now: float) -> None:
        """Slow down to a standstill where the motion leads."""
        self._time, self._overlay_time = self._time.towards(0.0, now), self._overlay_time.towards(0.0, now)

    def resume(self, now: float) -> None:
        """Go on where `pause` stopped."""
        self._time, self._overlay_time = self._time.towards(1.0, now), self._overlay_time.towards(1.0, now)

    def add(self, overlay: Overlay, axes: Array, fade: float, now: float) -> int:
        """Add an overlay along `axes` (3, 3), growing for `fade` s; return the handle by which to remove it."""
        self._next_handle += 1
        self._overlays[self._next_handle] = (FadedOverlay(overlay, self._overlay_time.at(now)[0], fade), axes.copy())
        return self._next_handle

    def remove(self, handle: int, now: float) -> None:
        """Let an overlay shrink to nothing; one that is gone already stays so."""
        if handle in self._overlays:
            faded, axes = self._overlays[handle]
            self._overlays[handle] = (faded.end_at(self._overlay_time.at(now)[0]), axes)

    def drop_overlays(self) -> None:
        """Forget all overlays at once, for who then takes up a pose anew."""
        self._overlays = {}

    def fade_overlays(self, now: float) -> None:
        """Let all overlays shrink to nothing."""
        for handle in self._overlays:
            self.remove(handle, now)

    def sample(self, now: float) -> Reference:
        """Return the reference."""
        self.path = self._motion(now)
        return self._overlaid(self.path, now) if self._overlays else self.path

    def _motion(self, now: float) -> Reference:
        time, rate, slope = self._time.at(now)
        if time >= self._ends:
            return self._rest
        motion = self._trajectory.at(time) if self._trajectory else self._rest
        if time < self._way.duration or time < self._turn.duration:
            motion = self._braking(motion, time)
        if rate == 1.0:
            return motion
        return Reference.of(motion.pose, rate * motion.twist, rate * rate * motion.acceleration + slope * motion.twist)

    def _braking(self, motion: Reference, time: float) -> Reference:
        """Add what is left of the motion before: r = offset + r_b, R = E R_b."""
        offset, velocity, acceleration = self._way.at(time)
        turn, spin, change = self._turn.at(time)
        E = exp(turn)
        turning = E @ motion.twist[3:]
        angular = change + E @ motion.acceleration[3:] + skew(spin) @ turning
        return Reference.of(
            Pose(motion.pose.position + offset, E @ motion.pose.rotation),
            np.concatenate([motion.twist[:3] + velocity, turning + spin]),
            np.concatenate([motion.acceleration[:3] + acceleration, angular]),
        )

    def _overlaid(self, motion: Reference, now: float) -> Reference:
        """Add the overlays."""
        time, rate, slope = self._overlay_time.at(now)
        rows = motion.rows.copy()
        for faded, axes in self._overlays.values():
            add_overlay(rows, faded.at(time), axes, rate, slope)
        if any(faded.is_over(time) for faded, _ in self._overlays.values()):
            self._overlays = {h: entry for h, entry in self._overlays.items() if not entry[0].is_over(time)}
        return Reference(rows)


@compiled
def add_overlay(rows: OutMatrix, motion: Matrix, axes: Matrix, rate: float, slope: float) -> None:
    """Add an overlay's motion (3, 3) along `axes` (3, 3) to a reference's rows (8, 3).

    The chain rule turns its time, of `rate`, into time.
    """
    added = np.empty((3, 3))
    product(motion, axes.T, added)
    for i in range(3):
        rows[0, i] += added[0, i]
        rows[4, i] += rate * added[1, i]
        rows[6, i] += slope * added[1, i] + rate * rate * added[2, i]
