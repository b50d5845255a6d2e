"""Whole tasks in simulation that are paused while a skill runs."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.evaluation.report.wiping import find_wipings, rate_wiping
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.preparation import Ready
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.motion.pose import Array
from skillc_runtime.recording.commands import Command, PauseRun, Resume
from skillc_runtime.recording.events import Event, StateChanged
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel


@dataclass
class PausedRun:
    """A run that is paused `after_s` s after the first start of `skill`, for `lasts_s` s; then it gets `command`.

    `still` are time and tool position of each arm, in every tick in which the run is paused; `contacts` what its events
    said of the contact of the tool, without repetition.
    """

    skill: str
    after_s: float
    lasts_s: float
    command: Command = field(default_factory=Resume)
    told: HistoryBuilder = field(default_factory=HistoryBuilder)
    still: list[tuple[float, Array]] = field(default_factory=list)
    contacts: list[str] = field(default_factory=list)
    requested_at: float = 0.0
    resumed_at: float = 0.0
    cell: SimulatedCell = field(init=False)
    run: TaskRun = field(init=False)

    def start(self, library: SkillLibrary, task: str, seed: int, most_s: float = 150.0) -> PausedRun:
        """Run a task of a library to its end, for `most_s` s of the cell at most."""
        scene, goal = library.tasks[task].scene, library.tasks[task].goal
        assert scene is not None and goal is not None
        state = load_scene(catalogue.scene_path(scene), library.vocabulary)
        prepared = prepare_task(Assignment(task, state, AchieveGoal(goal)), library)
        assert isinstance(prepared, PreparedTask), prepared
        self.cell = SimulatedCell(WorldModel(state), seed)
        loop = CellLoop(self.cell, library, lambda assignment, failures: Ready(prepared), after_tick=())
        self.run = loop.submit(prepared.assignment, (self.told, self._note_contact))
        while not self.run.ended and self.cell.now < most_s:
            self._request(loop)
            loop.tick()
        assert self.run.ended, f"{task} is {self.run.state} after {most_s} s"
        return self

    def _note_contact(self, event: Event) -> None:
        if isinstance(event, StateChanged) and self.contacts[-1:] != [event.contact]:
            self.contacts.append(event.contact)

    def _request(self, loop: CellLoop) -> None:
        now = self.cell.now
        if self.run.state == "paused":
            arms = [self.cell.arm(arm.individual) for arm in self.cell.scene.arms]
            self.still.append((now, np.concatenate([arm.measured.pose.position for arm in arms])))
        if not self.requested_at:
            began = [
                call.started
                for call in self.told.history.calls
                if call.skill == self.skill and call.started is not None
            ]
            if began and now >= began[0] + self.after_s:
                self.requested_at = now
                loop.request(self.run, PauseRun())
        elif not self.resumed_at and now >= self.requested_at + self.lasts_s:
            self.resumed_at = now
            self.act(loop)

    def act(self, loop: CellLoop) -> None:
        """End the pause."""
        loop.request(self.run, self.command)

    def moved_m(self, start: float, end: float) -> float:
        """How far the tools moved while the run was paused, between two times in s."""
        positions = np.array([position for time, position in self.still if start <= time < end])
        assert len(positions) > 1, "the run was not paused then"
        return float(np.abs(positions - positions[0]).max())

    def forces(self, start: float, end: float) -> Array:
        """Return the true forces in N of the one tool of the scene between two times in s."""
        (tool,) = self.cell.scene.tools
        return self.cell.ground_truth.recording(tool.individual).between(start, end).force

    @property
    def paused(self) -> tuple[float, float]:
        """When the run's own time stood still, in s."""
        ((start, end),) = self.told.history.paused
        return start, end

    def wiping(self) -> WipingResult:
        """Return the quality of the one wiping."""
        state = self.cell.world.snapshot()
        (wiping,) = find_wipings(self.told.history, state)
        return rate_wiping(wiping, state, self.cell.ground_truth)
