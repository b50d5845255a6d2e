"""Identifies the mass and the centre of mass of what a hand holds, by turning it and feeling its weight each time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from skillc_runtime.devices.arm import NotOffered
from skillc_runtime.devices.motion_interface import MotionModel
from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.primitives.arm_motion import ArmMotion
from skillc_runtime.primitives.collision_free_motion import move_collision_free
from skillc_runtime.primitives.computation import Computing
from skillc_runtime.primitives.compute_here import compute_here
from skillc_runtime.primitives.load_feeling import LoadFeeling
from skillc_runtime.primitives.payload_estimation import MOST_CONDITION, PayloadError
from skillc_runtime.primitives.primitive import SkillFailure, SpaceLacking, Status
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledQuantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import CENTRE_OF_MASS, WEIGHT

if TYPE_CHECKING:
    from skillc_runtime.devices.arm import ArmLoad
    from skillc_runtime.devices.cell import Cell

AHEAD_M: Final = 0.12
"""How far what is held is moved away from the base of the arm and towards it: its weight turns other joints there."""

STATIONS: Final = (
    ((0.0, 0.0, 0.0),),
    ((1.0, 0.0, 0.0), (0.8, 0.6, 0.0), (0.8, -0.6, 0.0), (0.5, 0.0, 0.0)),
    ((0.0, 1.0, 0.0), (-0.6, 0.8, 0.0), (0.6, 0.8, 0.0), (0.0, 0.5, 0.0)),
    ((0.0, 0.0, -AHEAD_M), (0.0, 0.0, -AHEAD_M / 2)),
    ((-1.0, 0.0, 0.0), (-0.8, -0.6, 0.0), (-0.8, 0.6, 0.0), (-0.5, 0.0, 0.0)),
    ((0.0, -1.0, 0.0), (0.6, -0.8, 0.0), (-0.6, -0.8, 0.0), (0.0, -0.5, 0.0)),
    ((0.0, 0.0, AHEAD_M), (0.0, 0.0, AHEAD_M / 2)),
    ((0.0, 0.0, 0.0),),
)
"""Where a load is felt: about which horizontal axes of the world the tool is turned, x and y, as shares of the tilt,
and how far it is moved away from the base, in m; the first of each that is free. It ends as it began: so a drift is
told apart."""

RESISTANCE_N: Final = 30.0
"""The greatest force against the motions: a weight that is not known, of the arm too, may be felt as half of it."""

CERTAIN_M: Final = 0.02
"""A centre of mass with a greater standard deviation is not known."""

LEAST_KG: Final = 0.005
"""What is found to weigh less is not held."""


class IdentifyPayload(ArmMotion):
    """Turns what `gripper` holds by `tilt` rad to each side, where it is free to, and feels its weight.

    Writes the mass and the centre of mass of the object, and lets the arm count with them. Fails, and changes nothing,
    if too few turns are free to tell the payload from the errors of the sensors.
    """

    def __init__(self, cell: Cell, *, arm: str, gripper: str, object: str, tilt: float, pace: float) -> None:
        super().__init__(cell, arm, RESISTANCE_N)
        self._gripper, self._object, self._tilt, self._pace = gripper, object, tilt, pace
        self._from = Pose.of((0.0, 0.0, 0.0))
        self._left: list[tuple[tuple[float, float, float], ...]] = []
        self._feeling = LoadFeeling(self.arm)
        self._moves = self._is_known = False

    def start(self) -> None:
        """Begin to turn; SkillFailure if the arm feels no weight, or the gripper does not hold the object."""
        if not self._feeling.is_possible:
            raise SkillFailure(
                "{arm} measures neither forces at its wrist nor the torques of its links: it cannot feel what "
                "{object} weighs",
                arm=self._label(self._individual),
                object=self._label(self._object),
            )
        if self.cell.gripper(self._gripper).holding != self._object:
            raise SkillFailure(
                "{gripper} does not hold {object}",
                gripper=self._label(self._gripper),
                object=self._label(self._object),
            )
        self._find_load()
        self._from, self._left, self._moves = self.arm.measured.pose, list(STATIONS), False
        super().start()

    def start_motion(self) -> Computing:
        """Go to the next station that is free; nothing moves if none is left."""
        self._moves = False
        lacking = SpaceLacking("the arm cannot turn what it holds")
        while self._left and not self._moves:
            goal = _LoadGoal(tuple(map(self._place, self._left.pop(0))), self.arm.measured.q)
            try:
                yield from move_collision_free(self.cell, self._individual, goal, self._pace, lacking)
                self._moves = True
            except SpaceLacking:
                continue

    def _place(self, station: tuple[float, float, float]) -> Pose:
        """Return where the tool is to be in the world."""
        x, y, ahead_m = station
        away = self._from.position - self.arm.measured.in_world(np.zeros(3))
        away[2] = 0.0
        ahead = away / max(float(np.linalg.norm(away)), 1e-9) * ahead_m
        return Pose(self._from.position + ahead, exp(self._tilt * np.array([x, y, 0.0])) @ self._from.rotation)

    def tick(self) -> Status:
        """Return SUCCESS once the payload is known and written; SkillFailure if errors of the sensors may be it."""
        compute_here(self)
        if self._is_known:
            return Status.SUCCESS if self.arm.compliance.tare() else Status.RUNNING
        if not self._moves:
            self._conclude()
            return Status.RUNNING
        if super().tick() is not Status.SUCCESS:
            return Status.RUNNING
        if self._feeling.feel(self.cell.now):
            self.computing = self._begin()
        return Status.RUNNING

    def resume(self) -> None:
        """Go on; what is felt in this posture is felt from the start."""
        super().resume()
        self._feeling.start_again()

    def _conclude(self) -> None:
        """Write what was found, and let the arm count with it."""
        error, before = self._feeling.estimate(), self._find_load()
        if error.condition > MOST_CONDITION:
            raise SkillFailure(
                "{object} could be taken to {free} of {all} postures, in which its weight cannot be told from the "
                "errors of the sensors: lift it to where it is free to turn",
                object=self._label(self._object),
                free=str(self._feeling.count),
                all=str(len(STATIONS)),
            )
        mass_kg, centre = add_error(before, error)
        if mass_kg < LEAST_KG:
            raise SkillFailure(
                "what {gripper} holds weighs {felt:.3f kg}: it does not hold {object}",
                gripper=self._label(self._gripper),
                felt=LabelledQuantity(mass_kg, "kg"),
                object=self._label(self._object),
            )
        is_certain = error.moment_deviation <= CERTAIN_M * mass_kg
        self._write(mass_kg, error, centre if is_certain else None)
        self.cell.gripper(self._gripper).correct_load(mass_kg, centre if is_certain else before.centre)
        self._is_known = True

    def _write(self, mass_kg: float, error: PayloadError, centre: Array | None) -> None:
        """Write the mass, and the centre of mass (3,) in m in the frame of the object if that is known."""
        found = [SetProperty(self._object, WEIGHT, round(mass_kg, 4))]
        where = f"where its centre of mass is, is not felt to {1e3 * CERTAIN_M:.0f} mm"
        if centre is not None:
            text = " ".join(f"{each:.4f}" for each in centre)
            found.append(SetProperty(self._object, CENTRE_OF_MASS, text))
            off_mm = 1e3 * error.moment_deviation / mass_kg
            where = f"its centre of mass is at ({text}) m, with one of {off_mm:.0f} mm"
        self.cell.world.commit(found, "IdentifyPayload", "sensed")
        name = self.cell.world.snapshot().vocabulary.short(self._object)
        self.note = (
            f"{name} weighs {mass_kg:.3f} kg, with a standard deviation of {1e3 * error.mass_deviation_kg:.0f} g in "
            f"{self._feeling.count} postures; {where}"
        )

    def _find_load(self) -> ArmLoad:
        """Return what the arm counts as held; SkillFailure if nothing tells."""
        try:
            load = self.cell.gripper(self._gripper).load
        except NotOffered:
            load = None
        if load is None:
            raise SkillFailure(
                "the driver of {gripper} does not tell with which payload the arm counts, so that it cannot be "
                "corrected",
                gripper=self._label(self._gripper),
            )
        return load

    def _label(self, individual: str) -> LabelledIri:
        return label(individual, self.cell.world.snapshot().vocabulary)


def add_error(load: ArmLoad, error: PayloadError) -> tuple[float, Array]:
    """Return the mass in kg and the centre of mass (3,) in m, in its own frame, of what is held with this error."""
    in_tool = load.tool.inverse() @ load.held
    mass_kg = load.mass_kg + error.mass_kg
    moment = load.mass_kg * in_tool.apply(load.centre) + error.moment
    return mass_kg, in_tool.inverse().apply(moment / max(mass_kg, LEAST_KG))


@dataclass(frozen=True, slots=True)
class _LoadGoal:
    """The postures that put the tool at one of several poses in the world, the best first; `seed` (nv,): rad, now."""

    tools: tuple[Pose, ...]
    seed: Array

    def find(self, model: MotionModel) -> Iterator[Array]:
        """Yield them."""
        for tool in self.tools:
            near = model.inverse_kinematics(tool, self.seed)
            if near is not None:
                yield near
            yield from model.rank_postures(tool, self.seed)[:2]
