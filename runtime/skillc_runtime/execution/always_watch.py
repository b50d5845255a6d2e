"""Whether what a task says holds always has held since the first step of its run."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from skillc_model.conditions import Condition
from skillc_runtime.planning.always import find_broken
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent


class AlwaysWatch:
    """Notes what is broken first, after each change of the world, whoever makes it."""

    def __init__(self, always: Sequence[Condition], world: WorldModel) -> None:
        self._always, self._world = tuple(always), world
        self._stop: Callable[[], None] | None = None
        self.broken: str | None = None
        """What was broken first, and why, as a clause; None as long as all has held."""

    def begin(self) -> None:
        """Watch from now on, unless that has begun before."""
        if self._always and self._stop is None:
            self.broken = find_broken(self._always, self._world.snapshot())
            self._stop = self._world.subscribe(self._look)

    def end(self) -> None:
        """Watch no more."""
        if self._stop is not None:
            self._stop()
            self._stop = None

    def _look(self, event: ChangeEvent) -> None:
        if self.broken is None:
            self.broken = find_broken(self._always, event.after)
