"""Making sure that a tool which works on a surface is pressed on it."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.world.space.surfaces import least_contact, least_force_n
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import CONTACT_SHARE

if TYPE_CHECKING:
    from skillc_runtime.robots.cell import Cell


class KeepContact(Primitive):
    """Feel, in every tick, whether the tool presses on a surface; note for which share of the time it did.

    SkillFailure when, of the last `over` s, it did not for more of the time than the surface allows.
    """

    def __init__(self, cell: Cell, *, arm: str, surface: str, over: float) -> None:
        super().__init__(cell)
        self.arm, self._surface, self._over = cell.arm(arm), surface, over
        state = cell.world.snapshot()
        self._least_n, self._share = least_force_n(state, surface), least_contact(state, surface)
        self._felt = self._samples = 0
        self._lost: deque[tuple[float, float]] = deque()
        self._lost_s = self._before = 0.0

    def start(self) -> None:
        """Begin to feel."""
        self._before = self.cell.now

    def tick(self) -> Status:
        """Feel once; SkillFailure where the tool was not pressed for too long."""
        now = self.cell.now
        pressed = -float(self.arm.wrench[:3] @ self.arm.pose.rotation[:, 2]) >= self._least_n
        self._samples, self._felt = self._samples + 1, self._felt + pressed
        if not pressed:
            self._lost.append((now, now - self._before))
            self._lost_s += now - self._before
        self._before = now
        while self._lost and now - self._lost[0][0] > self._over:
            self._lost_s -= self._lost.popleft()[1]
        if self._lost_s > (1 - self._share) * self._over:
            self._note()
            raise SkillFailure(self._words())
        return Status.RUNNING

    def halt(self, reason: str) -> None:
        """Note what was felt."""
        if self._samples:
            self._note()

    def _note(self) -> None:
        self.cell.world.commit(
            [SetProperty(self._surface, CONTACT_SHARE, self._felt / self._samples)], "KeepContact", "sensed"
        )

    def _words(self) -> str:
        name = self.cell.world.snapshot().vocabulary.short(self._surface)
        return (
            f"contact with {name} was lost for {self._lost_s:.1f} s of the last {self._over:g} s: the arm felt less "
            f"than {self._least_n:g} N; it must feel more for {self._share:.0%} of the time"
        )
