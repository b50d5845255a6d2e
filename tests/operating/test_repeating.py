"""What `skillc run` records can be repeated from its file: the events are equal but for wall times."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from msgspec.structs import replace

from operating.depot import write_depot
from operating.monitors import Monitor
from skillc.services.project.backends import BackendName, make_backend
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.running import RunOptions, run_task
from skillc.services.tasks.loading import load_task
from skillc_runtime.execution.repeat import repeat_run
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.recording.commands import Command, PauseRun, Resume, StepOver
from skillc_runtime.recording.events import PlanArrived, Requested
from skillc_runtime.recording.reader import TraceReader
from skillc_runtime.recording.run_spec import RunSpec


class Operator:
    """Pauses a run at a time of its cell, goes over one call, and continues a while later."""

    def __init__(self, at_s: float) -> None:
        self._wishes: list[tuple[float, Command]] = [
            (at_s, PauseRun()),
            (at_s + 3.0, StepOver()),
            (at_s + 5.0, Resume()),
        ]

    def __call__(self, run: TaskRun, now: float) -> Sequence[Command]:
        wanted = (PauseRun,) if run.state == "running" else (StepOver, Resume) if run.state == "paused" else ()
        if self._wishes and now >= self._wishes[0][0] and isinstance(self._wishes[0][1], wanted):
            return (self._wishes.pop(0)[1],)
        return ()


def check(spec: RunSpec, folder: Path, backend: BackendName, pause_at_s: float) -> None:
    """Run a task with an operator, and repeat it from its recording."""
    spec = replace(spec, out=str(folder), seed=3, backend=backend, film=False)
    with load_task(spec, SilentReporter()) as loaded:
        ran = run_task(loaded, RunOptions(spec), Monitor(Operator(pause_at_s)), SilentReporter())
    recorded = tuple(TraceReader(folder / "events.jsonl").events)
    assert ran.result.status == "succeeded", ran.result.failure
    asked = [event.command.name for event in recorded if isinstance(event, Requested)]
    assert asked == ["pause", "step-over", "resume"]
    assert any(isinstance(event, PlanArrived) for event in recorded)
    with load_task(spec, SilentReporter()) as loaded:
        repetition = repeat_run(recorded, loaded.library, make_backend(backend, loaded.world, seed=3))
    assert repetition.difference is None, str(repetition.difference)
    assert repetition.events == recorded


def test_a_recorded_run_without_devices_is_repeated(tmp_path: Path) -> None:
    write_depot(tmp_path)
    library = tmp_path / "depot.skill"
    library.write_text(library.read_text(encoding="utf-8").replace("2000 s", "1 s"), encoding="utf-8")
    spec = RunSpec(scene=str(tmp_path / "scene.ttl"), call="Deliver()", library=str(tmp_path))
    check(spec, tmp_path / "out", "mujoco", 0.5)


@pytest.mark.sim
@pytest.mark.parametrize("backend", ["mujoco", "kinematic"])
def test_a_recorded_run_that_was_paused_while_it_wiped_is_repeated(tmp_path: Path, backend: BackendName) -> None:
    check(RunSpec(task="clean_desk"), tmp_path / "out", backend, 26.0)
