"""The pause of a run: its own time stands still, tools are withdrawn if it lasts, and touch again before it ends."""

from __future__ import annotations

from typing import Literal, TypeAlias

from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.recording.contact import ContactState
from skillc_runtime.recording.events import Paused, Resumed

APPROACH_S = 30.0
"""How long, at the end of a pause, withdrawn tools may take until they are in contact again, in s of the cell."""

STILL_S = 0.3
"""For how long devices must be at rest to count as still: a push that ends fades out, and measured speeds are noisy."""

PausePhase: TypeAlias = Literal["none", "kept", "withdrawn", "approaching"]
"""kept: paused, tools go on pressing; withdrawn: they were taken off; approaching: they are to touch again."""


class PrimitivePause:
    """Pauses the active primitives of a run. Every method may raise what a primitive raises.

    `phase` is how far the pause is; `contact` what becomes of the tools that pressed when it began.
    """

    def __init__(self, context: TreeContext) -> None:
        self.phase: PausePhase = "none"
        self.contact: ContactState = "none"
        self._context = context
        self._approach_by = self._moved_at = 0.0

    @property
    def is_still(self) -> bool:
        """Whether the devices that the run has used have come to rest; pushes may go on."""
        return self.phase != "none" and self._context.time - self._moved_at >= STILL_S

    def begin(self) -> None:
        """Pause; if tools approach again already, withdraw them."""
        if self.phase == "none":
            self.phase = "kept"
            self._emit(Paused)
            self._moved_at = self._context.time
            self._context.stop_own_time()
            self._context.active.pause()
            self.contact = "kept" if self._context.active.is_pressing else "none"
        elif self.phase == "approaching":
            self._take_off()

    def withdraw(self) -> None:
        """Take the tools off what they press on, unless that was done."""
        if self.phase == "kept":
            self._take_off()

    def end(self) -> None:
        """Go on, at once or, if tools were withdrawn, as soon as they are in contact again."""
        if self.phase == "kept":
            self._go_on()
        elif self.phase == "withdrawn":
            self.phase, self._approach_by = "approaching", self._context.cell.now + APPROACH_S
            self.contact = "none" if self.contact == "none" else "approaching"

    def tick(self) -> None:
        """Look for faults of arms, and let withdrawn tools approach if the pause is to end."""
        fault = self._context.run_cell.take_fault()
        if fault is not None:
            raise SkillFailure(fault)
        if not self._context.run_cell.is_still:
            self._moved_at = self._context.time
        if self.phase == "approaching":
            self._approach()
        elif self.contact == "kept" and not self._context.active.is_pressing:
            self.contact = "none"
        elif self.contact == "lifting" and self.is_still:
            self.contact = "taken-off"

    def _take_off(self) -> None:
        self.phase, self._moved_at = "withdrawn", self._context.time
        self.contact = "none" if self.contact == "none" else "lifting"
        self._context.active.withdraw()

    def _approach(self) -> None:
        waiting = self._context.active.approach()
        if waiting is None:
            self._go_on()
        elif self._context.time > self._approach_by:
            name = type(waiting).__name__
            raise SkillFailure(f"{name} was not in contact again within {APPROACH_S:g} s of the end of the pause")

    def _go_on(self) -> None:
        self.phase = self.contact = "none"
        self._emit(Resumed)
        self._context.resume_own_time()
        self._context.active.resume()

    def _emit(self, event: type[Paused | Resumed]) -> None:
        self._context.begin_tick()
        if self._context.emit is not None:
            self._context.emit(event(time=self._context.time))
