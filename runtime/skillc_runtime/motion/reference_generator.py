"""The reference of the tool: a trajectory, the rest of the motion before it, and overlays, all in one frame."""

from __future__ import annotations

from math import inf

import numpy as np
from msgspec.structs import replace

from skillc_runtime.motion import reference_plan as plans
from skillc_runtime.motion.numerics.compiled import bind
from skillc_runtime.motion.overlays import GIVEN, FadedOverlay
from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.motion.reference import Overlay, Reference, Trajectory, resting_reference
from skillc_runtime.motion.reference_plan import make_plan, sample_reference
from skillc_runtime.motion.shift import Shift
from skillc_runtime.motion.stopping_motion import stopping_motion
from skillc_runtime.motion.time_scaling import RAMP_S, TimeScaling, start_time

TURN_DECELERATION = 2.0
"""Deceleration of a rotation in a stop, rad/s^2."""

LOOK_AHEAD_S = RAMP_S / 20
"""The time between two looks at the speed of the motion that a pause slows down, or that goes on after it."""


class ReferenceGenerator:
    """The reference of one tool, in the base frame.

    A motion starts where the one before it comes to rest; the two overlap in time, without a jump.
    Motion time starts with each motion, overlay time runs on, both `speed` times as fast as that of the clock; a pause
    slows both down to a standstill. Stops take the time that the deceleration wants, at any speed. `plan` has all of it
    as numbers; it is replaced with the table of a path. Times `now` are in s, of any clock.
    """

    def __init__(self, pose: Pose, deceleration: float) -> None:
        """Hold a pose; abandoned motions stop with `deceleration` m/s^2."""
        self._deceleration, self.speed = deceleration, 1.0
        self.plan, self._looked, self.is_given = make_plan(), np.zeros((8, 3)), False
        self._plan_with(self.plan.table)
        self._overlays: dict[int, tuple[FadedOverlay, Array]] = {}
        self._next_handle = 0
        self._overlay_time = TimeScaling()
        self.restart_from(pose, np.zeros(6), 0.0)

    def restart_from(self, pose: Pose, twist: Array, now: float) -> None:
        """Come to rest from a pose and a twist, whatever the motion was before.

        pose: in the base frame.
        twist: (6,) in m/s and rad/s, base axes.
        now: s.
        """
        speed = self.speed
        self._time, self._overlay_time = start_time(now, speed), self._overlay_time.towards(speed, now)
        self._way, self._turn = (
            stopping_motion(twist[:3] / speed, self._deceleration / speed**2),
            stopping_motion(twist[3:] / speed, TURN_DECELERATION / speed**2),
        )
        self._rest = resting_reference(
            Pose(pose.position + self._way.displacement, exp(self._turn.displacement) @ pose.rotation)
        )
        self._trajectory: Trajectory | None = None
        self._ends = max(self._way.duration, self._turn.duration)
        self._write()
        self.plan.path[:] = self._rest.rows

    @property
    def path(self) -> Reference:
        """The last sample without overlays; its arrays change."""
        return Reference(self.plan.path)

    def set_speed(self, speed: float, now: float) -> None:
        """Let motions, also the present one, have this share, above 0 to 1, of the speed that they were made with."""
        self.speed = speed
        if self._time.goal > 0.0:
            self._time = self._time.towards(speed, now)
        self._overlay_time = self._overlay_time.towards(speed, now)
        self._write()

    def follow(self, trajectory: Trajectory, now: float) -> None:
        """Follow a trajectory from now on; ValueError if it does not start at `stopping_pose`."""
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
        self._write()

    def stop(self, now: float) -> None:
        """Abandon the trajectory and come to rest."""
        motion = self._motion(now)
        self.restart_from(motion.pose, motion.twist, now)

    def jump_to(self, pose: Pose, along: Array, now: float) -> None:
        """Jump to a pose and come to rest there; of the present motion only the part along some axes continues.

        For directions in which the tool does not follow its reference anyway. Overlays are not part of the pose.
        pose: in the base frame.
        along: (3, n), unit vectors in the base frame, one a column.
        now: s.
        """
        twist = self._motion(now).twist.copy()
        twist[:3] = along @ (along.T @ twist[:3])
        self.restart_from(pose, twist, now)

    def path_pose(self, now: float) -> Pose:
        """Return the pose of the reference without overlays."""
        return self._motion(now).pose

    def stopping_pose(self, now: float) -> Pose:
        """Return the pose, without overlays, where the reference rests if it is stopped now: where a motion starts."""
        motion = self._motion(now)
        way = stopping_motion(motion.twist[:3], self._deceleration).displacement
        turn = stopping_motion(motion.twist[3:], TURN_DECELERATION).displacement
        return Pose(motion.pose.position + way, exp(turn) @ motion.pose.rotation)

    def done(self, now: float) -> bool:
        """Tell whether the motion has ended, and the one before it as well."""
        return self._time.at(now)[0] >= self._ends

    def at_rest(self, now: float) -> bool:
        """Tell whether the reference is at rest: the motion has ended and no overlay is left."""
        return self.done(now) and not self._overlays

    def stationary(self, now: float) -> bool:
        """Tell whether the reference stands still: at the end of the motion, or paused."""
        stands = self._time.at(now)[1] == 0.0 or self.done(now)
        return stands and (not self._overlays or self._overlay_time.at(now)[1] == 0.0)

    def pause(self, now: float) -> None:
        """Slow down to a standstill along the motion; the deceleration adds to that of the motion itself."""
        self._scale_time(0.0, now)

    def resume(self, now: float) -> None:
        """Continue after `pause`."""
        self._scale_time(self.speed, now)

    def _scale_time(self, rate: float, now: float) -> None:
        time, overlay_time = self._time.at(now)[0], self._overlay_time.at(now)[0]
        ramp_s, ahead = RAMP_S, 0.0
        while ahead <= max(RAMP_S, ramp_s / 2):  # a ramp covers half of its time of the motion
            ramp_s = max(ramp_s, self._stopping_time(time + ahead, overlay_time + ahead))
            ahead += LOOK_AHEAD_S
        self._time = self._time.towards(rate, now, ramp_s)
        self._overlay_time = self._overlay_time.towards(rate, now, ramp_s)
        self._write()

    def _stopping_time(self, time: float, overlay_time: float) -> float:
        """Return the time in s in which the motion, at its full speed, stops with the deceleration."""
        speed = turning = 0.0
        if time < self._ends:
            motion = self._trajectory.at(time) if self._trajectory else self._rest
            speed, turning = float(np.linalg.norm(motion.twist[:3])), float(np.linalg.norm(motion.twist[3:]))
        for faded, _ in self._overlays.values():
            speed += float(np.linalg.norm(faded.at(overlay_time)[1]))
        return max(speed / self._deceleration, turning / TURN_DECELERATION)

    def add(self, overlay: Overlay, axes: Array, fade: float, now: float) -> int:
        """Add an overlay; return the handle to remove it with. ValueError for too many at once.

        axes: (3, 3), axes (3, 3) of the overlay in the base frame.
        fade: s, how long it fades in.
        now: s.
        """
        if len(self._overlays) == plans.MOST_OVERLAYS:
            raise ValueError(f"a motion has at most {plans.MOST_OVERLAYS} overlays at once")
        self._next_handle += 1
        self._overlays[self._next_handle] = (FadedOverlay(overlay, self._overlay_time.at(now)[0], fade), axes.copy())
        self._write()
        return self._next_handle

    def remove(self, handle: int, now: float) -> None:
        """Fade an overlay out, also while paused; no effect if it has faded out already."""
        if handle in self._overlays:
            self._overlay_time = self._overlay_time.towards(self.speed, now)
            faded, axes = self._overlays[handle]
            self._overlays[handle] = (faded.end_at(self._overlay_time.at(now)[0]), axes)
            self._write()

    def drop_overlays(self) -> None:
        """Remove all overlays at once, for a caller that restarts from a pose next."""
        self._overlays = {}
        self._write()

    def fade_overlays(self, now: float) -> None:
        """Fade all overlays out."""
        for handle in self._overlays:
            self.remove(handle, now)

    def sample(self, now: float) -> Reference:
        """Return the reference at `now`."""
        self.prepare(now)
        if self._sample(now):
            self.forget_faded(now)
        return Reference(self.plan.rows.copy())

    def prepare(self, now: float) -> None:
        """Let the plan have what it cannot sample itself: motions and overlays that have no numbers."""
        if self.is_given:
            self._give_motion(self.plan.path, now)
            self._give_overlays(now)

    def set_shift(self, shift: Shift | None) -> None:
        """Add a displacement to the reference, beside its motion, from now on; None for none."""
        self.plan.motion[plans.SHIFTED] = shift is not None
        if shift is not None:
            self.plan.shift[:] = shift.numbers

    def forget_faded(self, now: float) -> None:
        """Forget overlays that have faded out."""
        time = self._overlay_time.at(now)[0]
        self._overlays = {h: entry for h, entry in self._overlays.items() if not entry[0].is_over(time)}
        self._write()

    def _motion(self, now: float) -> Reference:
        if self.is_given:
            self._give_motion(self._looked, now)
        self._look(now)
        return Reference(self._looked.copy())

    def _give_motion(self, path: Array, now: float) -> None:
        if self._trajectory is not None and self.plan.motion[plans.KIND] == plans.GIVEN:
            path[:] = self._trajectory.at(self._time.at(now)[0]).rows

    def _give_overlays(self, now: float) -> None:
        time = self._overlay_time.at(now)[0]
        for row, (faded, _) in zip(self.plan.overlays, self._overlays.values(), strict=False):
            if row[plans.OVERLAY_KIND] == GIVEN:
                row[plans.PARAMETERS :] = faded.overlay.at(time - faded.start).ravel()

    def _write(self) -> None:
        """Write the plan."""
        plan = self.plan
        plan.clocks[plans.MOTION], plan.clocks[plans.OVERLAID] = self._time.numbers, self._overlay_time.numbers
        for row, stop in zip(plan.stops, (self._way, self._turn), strict=True):
            row[:3], row[3] = stop.velocity, stop.duration
        plan.rest[:] = self._rest.rows
        table, factor, kind = _describe(self._trajectory)
        plan.motion[: plans.SHIFTED] = kind, self._ends, factor
        plan.overlays[:, plans.OVERLAY_KIND] = 0.0
        for row, (faded, axes) in zip(plan.overlays, self._overlays.values(), strict=False):
            _write_overlay(row, faded, axes)
        self.is_given = kind == plans.GIVEN or bool((plan.overlays[:, plans.OVERLAY_KIND] == GIVEN).any())
        if table is not plan.table:
            self._plan_with(table)

    def _plan_with(self, table: Array) -> None:
        self.plan = replace(self.plan, table=table)
        self._sample = bind(sample_reference, self.plan)
        self._look = bind(sample_reference, replace(self.plan, path=self._looked, rows=np.empty((8, 3))))


def _describe(trajectory: Trajectory | None) -> tuple[Array, float, float]:
    """Return the table of a motion, by how much it is slowed down, and its kind."""
    if trajectory is None:
        return plans.NO_TABLE, 1.0, plans.AT_REST
    tabled: tuple[Array, float] | None = getattr(trajectory, "tabled", None)
    if tabled is None:
        return plans.NO_TABLE, 1.0, plans.GIVEN
    table, factor = tabled
    return (table, factor, plans.ALONG_TABLE) if len(table) else (plans.NO_TABLE, 1.0, plans.AT_REST)


def _write_overlay(row: Array, faded: FadedOverlay, axes: Array) -> None:
    kind, *numbers = getattr(faded.overlay, "numbers", (GIVEN,))
    row[plans.OVERLAY_KIND], row[plans.START], row[plans.FADE] = kind, faded.start, faded.fade
    row[plans.END] = inf if faded.end is None else faded.end
    row[plans.OVERLAY_AXES : plans.PARAMETERS] = axes.ravel()
    row[plans.PARAMETERS : plans.PARAMETERS + len(numbers)] = numbers
