"""Weighs what a gripper holds: the arm feels by how much its load differs from what it compensates."""

from __future__ import annotations

from typing import Final

import numpy as np

from skillc_runtime.devices.cell import Cell
from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.arm_motion import raise_fault
from skillc_runtime.primitives.contradiction import contradict_place
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.data_sheet import SheetError, number_of
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledQuantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import CONTAIN, WEIGHT

SETTLING_S, AVERAGING_S, PATIENCE_S = 0.2, 0.3, 5.0
"""How long an arm stands still before it feels a weight, how long forces are averaged, and how long it may take."""

GRAVITY_M_S2: Final = 9.81


class Weigh(Primitive):
    """Compares the weight that the arm feels with the known one, up to `tolerance` kg; writes that the object is held.

    With the force F_z of the environment on the tool, from which the weight m g of what should be held is already
    subtracted, the felt mass is m - mean(F_z) / g.
    """

    moves = NOTHING

    def __init__(self, cell: Cell, *, arm: str, gripper: str, object: str, tolerance: float) -> None:
        super().__init__(cell)
        self.arm, self._arm = cell.arm(arm), arm
        self._gripper, self._object, self._tolerance_kg = gripper, object, tolerance
        self._known_kg = self._began = self._still_since = 0.0
        self._forces: list[Array] = []

    def start(self) -> None:
        """SkillFailure if the arm cannot feel weights, if another object or none is held, or one that is too light."""
        raise_fault(self.arm)
        if self.arm.measured.felt is None:
            raise SkillFailure(
                "{arm} measures neither forces nor torques: it cannot feel whether {gripper} holds {object}",
                arm=label(self._arm, self.cell.world.snapshot().vocabulary),
                gripper=self._hand,
                object=self._thing,
            )
        state, held = self.cell.world.snapshot(), self.cell.gripper(self._gripper).holding
        if held != self._object:
            raise SkillFailure("{gripper} does not hold {object}", gripper=self._hand, object=self._thing)
        try:
            self._known_kg = number_of(state, self._object, WEIGHT)
        except SheetError as error:
            raise SkillFailure(str(error)) from error
        if self._known_kg <= self._tolerance_kg:
            raise SkillFailure(
                "{object} weighs {known:.2f kg}: an arm that feels weights to {tolerance:.2f kg} cannot tell "
                "whether it is held",
                object=self._thing,
                known=LabelledQuantity(self._known_kg, "kg"),
                tolerance=LabelledQuantity(self._tolerance_kg, "kg"),
            )
        self._began = self._still_since = self.cell.now
        self._forces = []

    def resume(self) -> None:
        """Start again."""
        self.start()

    def tick(self) -> Status:
        """Return SUCCESS if the felt weight is the known one; SkillFailure if not, or if the arm keeps moving."""
        raise_fault(self.arm)
        now = self.cell.now
        if not self.arm.measured.still:
            self._still_since, self._forces = now, []
            if now - self._began > PATIENCE_S:
                raise SkillFailure("the arm does not stand still, so that it cannot weigh {object}", object=self._thing)
            return Status.RUNNING
        if now - self._still_since >= SETTLING_S:
            self._forces.append(self.arm.measured.wrench[:3].copy())
        if now - self._still_since < SETTLING_S + AVERAGING_S:
            return Status.RUNNING
        felt_kg = self._known_kg - float(np.mean(self._forces, axis=0)[2]) / GRAVITY_M_S2
        if abs(felt_kg - self._known_kg) > self._tolerance_kg:
            raise self._withdraw_place(felt_kg)
        self.cell.world.commit([AddRelation(self._gripper, CONTAIN, self._object)], "Weigh", "sensed")
        return Status.SUCCESS

    def _withdraw_place(self, felt_kg: float) -> SkillFailure:
        """Withdraw that the gripper holds the object; return the failure. What it holds instead, its fingers keep."""
        failure = SkillFailure(
            "what {gripper} holds weighs {felt:.2f kg}, {object} weighs {known:.2f kg}: it is something else, or "
            "something touches it",
            gripper=self._hand,
            felt=LabelledQuantity(felt_kg, "kg"),
            object=self._thing,
            known=LabelledQuantity(self._known_kg, "kg"),
        )
        return contradict_place(self.cell.world, "Weigh", self._object, failure)

    @property
    def _hand(self) -> LabelledIri:
        return label(self._gripper, self.cell.world.snapshot().vocabulary)

    @property
    def _thing(self) -> LabelledIri:
        return label(self._object, self.cell.world.snapshot().vocabulary)
