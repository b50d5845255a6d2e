"""Lowers what is held until it stands on something."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from skillc_runtime.primitives.arm_motion import raise_fault
from skillc_runtime.primitives.compliance import Push, yield_along
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.primitives.touch_guard import find_corners, find_nearest
from skillc_runtime.world.state.labels.labelled import LabelledQuantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import DEPTH

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.devices.guarded_push import MeasuredForce
    from skillc_runtime.motion.pose import Array

APPROACH_M_S: Final = 0.02
"""How fast a held thing is lowered."""

SUPPORT_N, SUPPORT_M = 4.0, 0.03
"""With which force it is felt whether something carries a held thing, and how far it is lowered for that."""

NOTHING_N: Final = SUPPORT_N / 2
"""Less than this that is felt of nothing does not spoil how gently it presses."""

CLEAR_M: Final = 0.005
"""What is believed to be further away than this does not touch a held thing."""

SINKING_M_S: Final = 0.005
"""A thing that sinks faster than this while it is pressed down is not carried."""

RISE_M: Final = 0.005
"""How far a thing rises at most while it is lowered, unless it is lighter than the arm believes."""

UP: Final = np.array([0.0, 0.0, 1.0])


class PressOnSupport(Push):
    """Lowers `object` opposite to `along` (3,), then presses it on what it stands on with `force` N in the scope.

    Fails if it touches nothing within `travel` m.
    """

    activity = ""

    def __init__(
        self, cell: Cell, *, arm: str, along: Array, object: str, to: str, force: float, travel: float
    ) -> None:
        super().__init__(cell, arm=arm, along=along, force=force, travel=travel, approach=APPROACH_M_S)
        self._object, self._to, self._along, self._travel = object, to, along, travel

    def tick(self) -> Status:
        """Return SUCCESS once the object presses on its support; SkillFailure if nothing supports it."""
        try:
            return self._tick_unless_sinking()
        except SkillFailure as failure:
            words = self.cell.world.snapshot().vocabulary
            raise SkillFailure(
                "nothing supports {object} where it should stand at {to}: {reason}; it was lowered by up to "
                "{travel:.0f mm}",
                object=label(self._object, words),
                to=label(self._to, words),
                reason=str(failure),
                travel=LabelledQuantity(self._travel, "m"),
            ) from failure

    def note_force(self, measured: MeasuredForce) -> None:
        """Write nothing: that something carries the object counts, and not with which force that was felt."""

    def _tick_unless_sinking(self) -> Status:
        status = super().tick()
        sinks = -float(self._along @ self.arm.measured.velocity[:3]) > SINKING_M_S
        return Status.RUNNING if sinks else status


class SupportCheck:
    """Feels whether something carries a held `object` at `to`: the arm yields, lowers it gently and presses on it.

    An arm that does not know its weight exactly would lift the object, or press too hard. So it is tared before if it
    feels something though nothing is believed to be near; else that may be what carries the object already.
    """

    def __init__(self, cell: Cell, arm: str, object: str, to: str) -> None:
        self._press = PressOnSupport(cell, arm=arm, along=UP, object=object, to=to, force=SUPPORT_N, travel=SUPPORT_M)
        self._cell, self._arm, self._object, self._to = cell, cell.arm(arm), object, to
        self._runs, self._tares, self._height_m = False, False, 0.0

    def start(self) -> None:
        """Begin to lower it; SkillFailure, and nothing moves, if the arm cannot yield upwards."""
        raise_fault(self._arm)
        self._runs = False
        felt = self._arm.measured.felt
        self._tares = felt is not None and abs(float(felt[2])) > NOTHING_N and self._is_clear()
        self._try_to_yield()

    def is_carried(self) -> bool:
        """Whether something is felt to carry it; to be called in each tick. It is not lowered until the arm is tared.

        SkillFailure if nothing does, or if the arm lifts it because it is lighter than the arm believes.
        """
        if not self._runs:
            raise_fault(self._arm)
            self._try_to_yield()
            return False
        carried = self._press.tick() is Status.SUCCESS
        if self._lifted_m - self._height_m > RISE_M:
            raise SkillFailure(
                "the arm does not feel whether something carries {object}: it rises while it is lowered, so it weighs "
                "less than is known",
                object=label(self._object, self._cell.world.snapshot().vocabulary),
            )
        return carried

    def _is_clear(self) -> bool:
        """Whether nothing is believed to be so near to the object that it touches that: no walls of a hole either."""
        state = self._cell.world.snapshot()
        if state.value(self._to, DEPTH) is not None:
            return False
        _, far_m = find_nearest(state, find_corners(state, self._object, self._arm.measured.pose))
        return far_m > CLEAR_M

    def _try_to_yield(self) -> None:
        """Begin to lower it, once the arm is tared where it is to be; SkillFailure if it cannot yield upwards."""
        if self._tares and not self._arm.compliance.tare():
            return
        self._height_m = self._lifted_m
        yield_along(self._arm, UP, 0.0)
        self._runs = True
        self._press.start()

    @property
    def _lifted_m(self) -> float:
        return float(self._arm.measured.pose.position[2])

    def end(self) -> None:
        """Neither press nor yield any more."""
        if self._runs:
            self._runs = False
            self._press.release()
            self._arm.compliance.restore()
