"""Episodes of a search that is steered: a trial of a task, from where the search begins to where it ends."""

from __future__ import annotations

from typing import Literal, TypeAlias

from msgspec import structs

from skillc_model.skills import Primitive, SkillLibrary
from skillc_runtime.devices.backend import Backend
from skillc_runtime.evaluation.trials.experiment import TrialRunner
from skillc_runtime.execution.attempt import TICK_S
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.primitives.steering import SteeredSearch, Steering, steering
from skillc_runtime.recording.events import Event, NodeEnded

Outcome: TypeAlias = Literal["found", "given up"]
"""How a search has ended: what it was for has succeeded, or not."""
SPIRAL = {"arm", "plane", "pitch", "speed", "radius"}
STEERED = "skillc_runtime.primitives.steering:SteeredSearch"


class NotSteered(Exception):
    """A task has no search that can be steered, or ended before it; the message says which."""


def steer_library(library: SkillLibrary, skill: str) -> SkillLibrary:
    """Return a library whose implementations of a skill, which adds a spiral, are steered; NotSteered without any."""
    if skill not in library.skills or {each.name for each in library.skills[skill].parameters} != SPIRAL:
        raise NotSteered(f"`{skill}` cannot be steered: it is no skill with the parameters of OverlaySpiral")
    own = {
        name: structs.replace(each, body=Primitive(STEERED))
        for name, each in library.implementations.items()
        if each.skill == skill
    }
    return structs.replace(library, implementations={**library.implementations, **own})


class Episodes:
    """Episodes of the trials of `runner`, whose library is steered; `until` is the skill that ends a search well."""

    def __init__(self, runner: TrialRunner, until: str) -> None:
        self._runner, self._until, self._steering = runner, until, Steering()
        self._running: tuple[CellLoop, TaskRun] | None = None
        self.outcome: Outcome | None = None

    @property
    def search(self) -> SteeredSearch | None:
        """The search, while it goes on."""
        return None if self.outcome else self._steering.active

    @property
    def cell(self) -> Backend:
        """The back end of the cell of the episode."""
        assert self._running is not None, "an episode"
        return self._running[0].backend

    @property
    def now(self) -> float:
        """The time of the cell in s."""
        return self.cell.clock.now

    def begin(self, seed: int) -> SteeredSearch:
        """Run the trial of a seed to where its search begins; NotSteered if it ends before.

        NotRecorded, SheetError or FrameError if it cannot start.
        """
        self.close()
        self.outcome, self._steering = None, Steering()
        self._running = self._runner.begin(seed, self._hear)
        while self._steering.active is None and not self._running[1].ended:
            self._tick()
        if self._steering.active is None:
            raise NotSteered(f"the task has ended before its search: {self._running[1].failure or 'it succeeded'}")
        return self._steering.active

    def advance(self, seconds: float) -> None:
        """Let the cell go on, at most until the search ends."""
        for _ in range(round(seconds / TICK_S)):
            if self.search is None:
                break
            self._tick()
        if self.search is None and self.outcome is None:
            self.outcome = "given up"

    def close(self) -> None:
        """End the episode."""
        if self._running is not None:
            self._running[0].close("the episode has ended")
            self._running = None

    def _tick(self) -> None:
        assert self._running is not None, "an episode"
        loop, _ = self._running
        token = steering.set(self._steering)
        try:
            if not loop.tick():
                loop.wait(1.0)
        finally:
            steering.reset(token)

    def _hear(self, event: Event) -> None:
        if isinstance(event, NodeEnded) and self._steering.active is not None and event.name == self._until:
            self.outcome = "found" if event.status == "success" else "given up"
