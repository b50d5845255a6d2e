"""A recorded run in a cell with a control thread, in a process of its own: `run_by_the_clock.py FOLDER TIMEOUT HOW`.

The devices write where their joints are into the file JOINTS, in each control period; it survives the process.
"""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ends.breaking import FOR_EVER_S, Swinging
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.recorded_run import RecordedRun, RecordingOptions, recorded_run
from skillc.services.tasks.loading import LoadedTask, load_task
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.real_time.cell import RealTimeCell
from skillc_runtime.backends.simulation.steps import InPython
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.execution.assignment import PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.numerics.program import Part
from skillc_runtime.recording.events import FORMAT, TaskStarted
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.state.model import WorldModel

LIBRARY = Path(__file__).with_name("blocking.skill")
ARM = "http://example.org/lab#Iiwa-1"
JOINTS = "joints.npy"
PERIODS, COUNT = 60_000, 7


class RecordingCell(KinematicCell):
    """A cell whose devices record their joints; rows that were not written are not numbers."""

    def __init__(self, world: WorldModel, path: Path) -> None:
        super().__init__(world)
        self._rows = np.lib.format.open_memmap(path, "w+", float, (PERIODS, COUNT))
        self._rows[:] = np.nan
        self._period = 0

    def _parts(self) -> Iterator[Part]:
        yield from super()._parts()
        yield InPython(self._record)

    def _record(self, _now: float) -> None:
        self._rows[self._period] = self.arms[ARM].state().q
        self._period += 1


def run_task(task: LoadedTask, cell: RealTimeCell, run: RecordedRun) -> None:
    """Run a task whose primitive blocks: the arm's heartbeat stops, too."""
    prepared = prepare_task(task.assignment, task.library)
    assert isinstance(prepared, PreparedTask)
    execute_task(prepared, task.library, cell, (run.publisher,), lambda: run.watchdog.count_tick(cell.now))


def only_swing(cell: RealTimeCell, run: RecordedRun) -> None:
    """Block with signs of life from another thread, so that nothing but the watchdog process stops the arm."""

    def beat() -> None:
        while cell.watchdog.beat("run", cell.now):
            time.sleep(0.01)

    run.publisher(TaskStarted(time=cell.now, format=FORMAT, task="swing"))
    threading.Thread(target=beat, daemon=True).start()
    Swinging(cell, arm=ARM).start()
    cell.advance(0.5)
    run.watchdog.count_tick(cell.now)
    time.sleep(FOR_EVER_S)


def main(folder: Path, timeout_s: float, how: str) -> None:
    request = RunSpec(task=f"{LIBRARY}:{'sleep' if how == 'alive' else how}")
    options = RecordingOptions(folder, timeout_s)
    with (
        load_task(request, SilentReporter()) as task,
        recorded_run(TaskResult(task=how, status="interrupted"), options, SilentReporter()) as run,
    ):
        inside = RecordingCell(task.world, folder / JOINTS)
        cell = RealTimeCell(inside, lambda: run.watchdog.is_stop_requested)
        if how == "alive":
            only_swing(cell, run)
        else:
            run_task(task, cell, run)


if __name__ == "__main__":
    main(Path(sys.argv[1]), float(sys.argv[2]), sys.argv[3])
