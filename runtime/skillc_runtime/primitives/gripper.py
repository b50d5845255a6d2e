"""Moves the fingers of a gripper: one class for each kind, since their commands differ."""

from __future__ import annotations

from collections.abc import Mapping

from skillc_runtime.devices.cell import Cell
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.primitives.space_needs import Open, SpaceNeed
from skillc_runtime.primitives.time_limits import finger_limit_s
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledQuantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

TOLERANCE_M = 0.003


class ParallelGripper(Primitive):
    """Two parallel fingers, commanded by opening in m and force in N."""

    moves = NOTHING

    @classmethod
    def find_problem(cls, arguments: Mapping[str, Value], state: WorldState) -> str | None:
        """Return that the fingers cannot open so far."""
        opening, gripper = arguments.get("opening"), arguments.get("gripper")
        if not isinstance(opening, float) or not isinstance(gripper, str):
            return None
        widest = sheet_of(state, gripper).number("maxOpening")
        return str(_too_wide(label(gripper, state.vocabulary), widest, opening)) if _is_wider(opening, widest) else None

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return how far the fingers open."""
        opening, gripper = arguments.get("opening"), arguments.get("gripper")
        return (Open(gripper, opening),) if isinstance(gripper, str) and isinstance(opening, float) else None

    def __init__(self, cell: Cell, *, gripper: str, opening: float, force: float) -> None:
        super().__init__(cell)
        self._gripper = cell.gripper(gripper)
        self._name, self._opening, self._force = gripper, opening, force
        self._limit_s = self._ends = 0.0

    def start(self) -> None:
        """Start moving; SkillFailure if the fingers cannot open so far, or would let go of what they hold."""
        held = self._gripper.holding
        if held is not None and self._opening > self._gripper.opening_m + TOLERANCE_M:
            raise SkillFailure(
                "{gripper} holds {object}: only Release lets it go, where something carries it",
                gripper=self._label,
                object=label(held, self.cell.world.snapshot().vocabulary),
            )
        if _is_wider(self._opening, self._gripper.max_opening_m):
            raise _too_wide(self._label, self._gripper.max_opening_m, self._opening)
        self._limit_s = finger_limit_s(self.cell.world.snapshot(), self._name, self._gripper.max_opening_m)
        self._move()

    def _move(self) -> None:
        self._ends = self.cell.now + self._limit_s
        self._gripper.move(*self.command())

    @property
    def _label(self) -> LabelledIri:
        return label(self._name, self.cell.world.snapshot().vocabulary)

    def command(self) -> tuple[float, float]:
        """Return the commanded opening in m and force in N."""
        return self._opening, self._force

    def tick(self) -> Status:
        """Return SUCCESS when the fingers are at rest.

        SkillFailure if they did not open as far as commanded, or do not come to rest.
        """
        if self._gripper.moving:
            if self.cell.now > self._ends:
                raise self._restlessness()
            return Status.RUNNING
        opening = self._gripper.opening_m
        if opening < self._opening - TOLERANCE_M:
            raise SkillFailure(
                "{gripper} is {opening:.0f mm} open, not {wanted:.0f mm}: something is in the way",
                gripper=self._label,
                opening=LabelledQuantity(opening, "m"),
                wanted=LabelledQuantity(self._opening, "m"),
            )
        return Status.SUCCESS

    def _restlessness(self) -> SkillFailure:
        return SkillFailure(
            "the fingers of {gripper} have not come to rest within {limit:.1f}: they are {opening:.0f mm} open, not "
            "{wanted:.0f mm}",
            gripper=self._label,
            limit=LabelledQuantity(self._limit_s, "s"),
            opening=LabelledQuantity(self._gripper.opening_m, "m"),
            wanted=LabelledQuantity(self._opening, "m"),
        )

    def halt(self, reason: str) -> None:
        """Stop the fingers."""
        self._gripper.stop()

    def pause(self) -> None:
        """Stop the fingers."""
        self._gripper.stop()

    def resume(self) -> None:
        """Continue the motion."""
        self._move()


def _is_wider(opening_m: float, widest_m: float) -> bool:
    return opening_m > widest_m + TOLERANCE_M


def _too_wide(gripper: LabelledIri, widest_m: float, opening_m: float) -> SkillFailure:
    return SkillFailure(
        "{gripper} opens to {widest:.0f mm}, not to {wanted:.0f mm}",
        gripper=gripper,
        widest=LabelledQuantity(widest_m, "m"),
        wanted=LabelledQuantity(opening_m, "m"),
    )


class ThreeFingerGripper(ParallelGripper):
    """Three coupled fingers, whose controller takes opening and force in equal steps up to their maximum values."""

    def start(self) -> None:
        """Look up the number of steps and start moving; SkillFailure if the data sheet does not have it."""
        try:
            self._steps = sheet_of(self.cell.world.snapshot(), self._name).number("commandSteps")
        except SheetError as error:
            raise SkillFailure(str(error)) from error
        super().start()

    def command(self) -> tuple[float, float]:
        """Return opening in m and force in N, rounded to steps."""
        largest, strongest = self._gripper.max_opening_m, self._gripper.max_force_n
        return self._round_to_step(self._opening, largest), self._round_to_step(self._force, strongest)

    def _round_to_step(self, value: float, maximum: float) -> float:
        return min(round(value / maximum * self._steps), self._steps) * maximum / self._steps
