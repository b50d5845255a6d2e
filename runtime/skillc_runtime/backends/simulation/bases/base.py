"""A simulated mobile base: it rotates, drives straight and rotates again, each with a trapezoidal profile."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import msgspec
import numpy as np
from msgspec.structs import replace

from skillc_runtime.backends.simulation.bases.base_drive import (
    DURATION,
    FREE,
    PROFILE,
    SIZE,
    STEPS,
    STEPS_PER_CHECK,
    TIME,
    TURN,
    DrivenLeg,
    drive,
)
from skillc_runtime.backends.simulation.bases.bumper import Bumper
from skillc_runtime.backends.simulation.names import base_body_name
from skillc_runtime.backends.simulation.scene_spec import BaseSpec
from skillc_runtime.motion.numerics.compiled import bind
from skillc_runtime.motion.paths.profile import Profile, trapezoidal_profile
from skillc_runtime.motion.pose import Array, Pose, exp, quaternion_from_rotation

NEAR_M = 1e-3
"""Shorter motions, in m or rad, are left out."""


class Leg(msgspec.Struct, frozen=True):
    """One part of a drive: `profile` along the unit vector `direction` (3,) in the world, or of a rotation.

    sign: of the rotation about the vertical; 0 for a straight leg.
    """

    start: Pose
    profile: Profile
    direction: Array
    sign: float

    def at(self, time: float) -> Pose:
        """Return the base's pose `time` s after the leg's start."""
        way = self.profile.at(time)[0]
        if not self.sign:
            return Pose(self.start.position + way * self.direction, self.start.rotation)
        return Pose(self.start.position, exp(np.array([0.0, 0.0, self.sign * way])) @ self.start.rotation)

    @property
    def end(self) -> Pose:
        """The base's pose at the end of the leg."""
        return self.at(self.profile.duration)


@dataclass(frozen=True)
class BaseStep:
    """One step of a base that moves: its poses in the world before and after it, and its number in the drive."""

    before: Pose
    after: Pose
    number: int = 0

    @cached_property
    def motion(self) -> Pose:
        """The motion in the world: new = motion @ old."""
        return self.after @ self.before.inverse()


class SimulatedBase:
    """One mobile base of a simulated cell, implementing `MobileBase`; `touched` is what stopped it, ground truth.

    `drive` makes a step of a base that moves, or returns 1 where `step` has to.
    """

    def __init__(self, facts: BaseSpec, name: str, model: Any, data: Any) -> None:
        mocap = int(model.body_mocapid[model.body(base_body_name(name)).id])
        self._position, self._quaternion = data.mocap_pos[mocap], data.mocap_quat[mocap]
        self._facts, self._pose = facts, facts.pose
        self._turned_to: Array | None = None
        self._done, self._stopped, self._speed = True, False, 1.0
        self._legs: list[Leg] = []
        self._bumper = Bumper(base_body_name(name), model, data)
        self._leg, self._start, self._turned, self._along = np.zeros(SIZE), np.zeros(3), np.zeros(4), np.zeros(3)
        places = self._start, self._turned, self._along, self._position, self._quaternion
        self.drive = bind(drive, DrivenLeg(self._leg, *places, model.opt.timestep))
        self._fault: str | None = None
        self.touched: str | None = None

    @property
    def pose(self) -> Pose:
        """The pose of the base."""
        return self._legs[0].at(self._leg[TIME]) if self._legs else self._pose

    @property
    def done(self) -> bool:
        """Whether the base has arrived at the last goal."""
        return self._done

    @property
    def at_rest(self) -> bool:
        """Whether the base does not move, at a goal or elsewhere."""
        return not self._legs

    @property
    def fault(self) -> str | None:
        """Why the base stopped by itself on the way to the last goal; None if it did not."""
        return self._fault

    @property
    def speed(self) -> float:
        """The share, above 0 to 1, of its speeds with which the base drives."""
        return self._speed

    def set_speed(self, share: float) -> None:
        """Drive with this share of the speeds from the next goal on."""
        self._speed = share

    def place(self, pose: Pose) -> None:
        """Put a base that is at rest somewhere else."""
        self._pose = pose
        self._position[:] = pose.position
        if pose.rotation is not self._turned_to:
            self._turned_to, self._quaternion[:] = pose.rotation, quaternion_from_rotation(pose.rotation)

    def drive_to(self, goal: Pose) -> None:
        """Begin to drive: brake if the base moves, rotate towards the goal, drive straight, rotate to its heading.

        ValueError if the goal is not finite.
        """
        if not (np.isfinite(goal.position).all() and np.isfinite(goal.rotation).all()):
            raise ValueError("a base cannot drive to a pose that has a part which is no number")
        self.stop()
        here = self.pose
        start = self._legs[0].end if self._legs else here
        way = (goal.position - start.position) * [1.0, 1.0, 0.0]
        distance = float(np.linalg.norm(way))
        heading = math.atan2(way[1], way[0]) if distance > NEAR_M else _heading(goal)
        first = self._turn(start, heading)
        straight = self._straight(first.end, way, distance)
        last = self._turn(straight.end, _heading(goal))
        self._legs += [leg for leg in (first, straight, last) if leg.profile.length > NEAR_M]
        self._stopped, self._done = False, not self._legs
        self._fault = self.touched = None
        self._bumper.begin(here)
        self._leg[STEPS] = 0.0
        self._begin_leg(self._leg[TIME])

    def stop(self) -> None:
        """Brake on the present leg and drop the others."""
        self._stopped, self._done = True, False
        if self._legs and self._legs[0].profile.length > 0:
            leg = self._legs[0]
            way, speed, _ = leg.profile.at(self._leg[TIME])
            peak, brake = leg.profile.peak, leg.profile.deceleration
            self._legs = [replace(leg, profile=trapezoidal_profile(way + speed * speed / (2 * brake), peak, brake))]
            self._begin_leg(self._leg[TIME])

    def step(self, period_s: float) -> BaseStep | None:
        """Advance by one step; return it, None when at rest."""
        if not self._legs:
            return None
        leg, before = self._legs[0], self.pose
        self._leg[TIME] += period_s
        self._leg[STEPS] += 1.0
        time, number = float(self._leg[TIME]), int(self._leg[STEPS])
        pose = leg.at(time)
        if number % STEPS_PER_CHECK == 0 and self._is_blocked(leg, time):
            self.place(before)
            return None
        self.place(pose)
        if time >= leg.profile.duration:
            self._legs = self._legs[1:]
            self._begin_leg(0.0)
            self._done = not self._legs and not self._stopped
        return BaseStep(before, pose, number)

    def _begin_leg(self, time: float) -> None:
        """Let `drive` move along the leg that is the first one now, from `time` s after its start."""
        self._leg[TIME], self._leg[FREE] = time, 0.0
        if self._legs:
            leg = self._legs[0]
            self._leg[[TURN, DURATION]] = leg.sign, leg.profile.duration
            self._leg[PROFILE:] = leg.profile.coefficients[:5]
            self._start[:], self._along[:] = leg.start.position, leg.direction
            self._turned[:] = quaternion_from_rotation(leg.start.rotation)

    def _is_blocked(self, leg: Leg, time: float) -> bool:
        """Stop at once if the base would touch something `time` s after the start of a leg; tell whether it would."""
        way = leg.profile.at(time)[0]
        if way < self._leg[FREE] and self._bumper.obstacles_stand:
            return False
        self.touched = self._bumper.touched(leg.at(time))
        self._leg[FREE] = way + self._bumper.free_m / (self._bumper.reach_m if leg.sign else 1.0)
        if self.touched is not None:
            self._legs, self._leg[TIME], self._stopped = [], 0.0, True
            self._fault = "its bumper touched something"
        return self.touched is not None

    def _turn(self, start: Pose, heading: float) -> Leg:
        angle = math.remainder(heading - _heading(start), math.tau)
        profile = trapezoidal_profile(abs(angle), self._speed * self._facts.turn_speed, self._facts.turn_acceleration)
        return Leg(start, profile, np.zeros(3), math.copysign(1.0, angle))

    def _straight(self, start: Pose, way: Array, distance: float) -> Leg:
        profile = trapezoidal_profile(distance, self._speed * self._facts.speed, self._facts.acceleration)
        return Leg(start, profile, way / max(distance, NEAR_M), 0.0)


def _heading(pose: Pose) -> float:
    """Return the direction of a pose's x axis on the floor, in rad."""
    return math.atan2(pose.rotation[1, 0], pose.rotation[0, 0])
