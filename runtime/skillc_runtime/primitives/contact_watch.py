"""Monitors that a tool which works on a surface stays in contact with it."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.world.space.surfaces import least_contact_share, least_force_n
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.labels.labelled import LabelledQuantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import CONTACT_SHARE

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell


class KeepContact(Primitive):
    """Checks in every tick whether the tool presses on a surface; writes the share of the time in which it did.

    An arm that neither measures forces nor torques knows only what it is to exert: the share is assumed then.

    SkillFailure if contact was lost, within the last `over` s, for longer than the surface allows.
    """

    moves = NOTHING
    stays_put = True

    def __init__(self, cell: Cell, *, arm: str, surface: str, over: float) -> None:
        super().__init__(cell)
        self.arm, self._surface, self._over = cell.arm(arm), surface, over
        state = cell.world.snapshot()
        self._least_n, self._share = least_force_n(state, surface), least_contact_share(state, surface)
        self._contacts = self._samples = 0
        self._lost: deque[tuple[float, float]] = deque()
        self._lost_s = self._before = 0.0

    def start(self) -> None:
        """Start monitoring."""
        self._before = self.cell.now

    def tick(self) -> Status:
        """Measure once; SkillFailure if contact was lost for too long."""
        now = self.cell.now
        pressed = self.arm.measured.pressing_n >= self._least_n
        self._samples, self._contacts = self._samples + 1, self._contacts + pressed
        if not pressed:
            self._lost.append((now, now - self._before))
            self._lost_s += now - self._before
        self._before = now
        while self._lost and now - self._lost[0][0] > self._over:
            self._lost_s -= self._lost.popleft()[1]
        if self._lost_s > (1 - self._share) * self._over:
            self._note()
            raise self._failure()
        return Status.RUNNING

    def halt(self, reason: str) -> None:
        """Write the share of the time with contact."""
        if self._samples:
            self._note()

    def _note(self) -> None:
        share = SetProperty(self._surface, CONTACT_SHARE, self._contacts / self._samples)
        self.cell.world.commit([share], "KeepContact", "assumed" if self.arm.measured.felt is None else "sensed")

    def _failure(self) -> SkillFailure:
        return SkillFailure(
            "contact with {surface} was lost for {lost:.1f} of the last {over}: the arm measured less than {least}; "
            "it must measure more for {share:.0%} of the time",
            surface=label(self._surface, self.cell.world.snapshot().vocabulary),
            lost=LabelledQuantity(self._lost_s, "s"),
            over=LabelledQuantity(self._over, "s"),
            least=LabelledQuantity(self._least_n, "N"),
            share=LabelledQuantity(self._share),
        )
