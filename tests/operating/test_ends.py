"""However a task ends, its result, its events and its report are complete and agree, and nothing moves after it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np
import pytest
from msgspec.structs import replace

from operating.depot import write_depot
from operating.monitors import Monitor, Script
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.running import ReportedRun, RunOptions, run_task
from skillc.services.tasks.loading import load_task
from skillc_ontology import catalogue
from skillc_runtime.devices.backend import BackendBroken
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.execution.attempt import TICK_S
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.recording.commands import Command, PauseRun, Resume, Stop
from skillc_runtime.recording.events import Paused, Resumed, TaskEnded, TaskStarted
from skillc_runtime.recording.reader import TraceReader
from skillc_runtime.recording.run_spec import RunSpec

LAB = "http://example.org/lab#"


def stop_after(seconds: float) -> Script:
    """Return the script of somebody who stops the run at a time of its cell."""
    return lambda _run, now: (Stop("enough"),) if now >= seconds else ()


def pause_then_stop(run: TaskRun, now: float) -> Sequence[Command]:
    if run.state == "paused":
        return (Stop("enough"),)
    return (PauseRun(),) if run.state == "running" and now >= 0.5 else ()


def stop_while_planning(run: TaskRun, _now: float) -> Sequence[Command]:
    return () if run.state == "running" else (Stop("enough"),)


@dataclass(frozen=True)
class Case:
    """What is run, by whom, with which options, and how it ends."""

    call: str
    status: str
    failure: str | None
    script: Script = lambda _run, _now: ()
    deadline_s: float | None = None


CASES = {
    "success": Case("Lift()", "succeeded", None),
    "failure": Case("Drop()", "failed", "it fell"),
    "exit of a primitive": Case("Leave()", "failed", "SystemExit"),
    "error of a primitive": Case("Crack()", "failed", "what was expected is missing"),
    "stop": Case("Deliver()", "stopped", "enough", stop_after(1.5)),
    "stop of a pause": Case("Deliver()", "stopped", "enough", pause_then_stop),
    "stop before it runs": Case("Deliver()", "stopped", "enough", stop_while_planning),
    "deadline": Case("Deliver()", "failed", "deadline of 2 s", deadline_s=2.0),
}


def read_ends(out: Path) -> tuple[TaskResult, TaskEnded, str]:
    """Return the result, the last event and the report in a folder; the recording begins with the start of the task."""
    result = msgspec.json.decode((out / "result.json").read_bytes(), type=TaskResult)
    first, *_, last = TraceReader(out / "events.jsonl").events
    assert isinstance(first, TaskStarted) and isinstance(last, TaskEnded)
    assert Path(first.scene).is_file()
    return result, last, (out / "report.html").read_text(encoding="utf-8")


def run(spec: RunSpec, monitor: Monitor, out: Path | None = None) -> ReportedRun:
    spec = replace(spec, out=None if out is None else str(out))
    with load_task(spec, SilentReporter()) as loaded:
        return run_task(loaded, RunOptions(spec), monitor, SilentReporter())


def request_in(folder: Path, call: str | None = None, goal: str | None = None) -> RunSpec:
    write_depot(folder)
    return RunSpec(scene=str(folder / "scene.ttl"), call=call, goal=goal, library=str(folder))


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_result_events_and_report_agree(tmp_path: Path, case: Case) -> None:
    monitor = Monitor(case.script)
    spec = replace(request_in(tmp_path, case.call), deadline_s=case.deadline_s)
    ran = run(spec, monitor, tmp_path / "out")
    result, ended, report = read_ends(tmp_path / "out")
    assert ran.written and result == ran.result
    assert result.status == ended.status == case.status
    assert (result.failure is None) == (ended.failure is None) == (case.failure is None)
    if case.failure is not None:
        assert ended.failure is not None and result.failure is not None
        assert case.failure in ended.failure.message and case.failure in result.failure and case.failure in report
    assert result.sim_time_s == ended.time
    assert monitor.events[-1] == ended


def test_a_goal_without_a_plan_is_refused_and_the_refusal_is_written(tmp_path: Path) -> None:
    ran = run(request_in(tmp_path, goal="lab:shelf contain lab:crate"), Monitor(), tmp_path / "out")
    result, ended, report = read_ends(tmp_path / "out")
    assert result == ran.result and (result.status, ended.status) == ("refused", "failed")
    assert ended.failure is not None and ended.failure.kind == "plan"
    assert result.failure == ended.failure.message and result.sim_time_s == 0.0
    assert "refused" in report


def test_a_task_that_is_interrupted_while_its_cell_is_built_is_stopped(tmp_path: Path) -> None:
    def interrupt(message: str) -> None:
        raise KeyboardInterrupt

    monitor = Monitor()
    monitor.say = interrupt  # type: ignore[method-assign]
    ran = run(request_in(tmp_path, "Deliver()"), monitor, tmp_path / "out")
    result, ended, report = read_ends(tmp_path / "out")
    assert result == ran.result and result.status == ended.status == "stopped"
    assert result.failure == "interrupted" and "interrupted" in report


@pytest.mark.sim
def test_an_arm_does_not_move_after_a_stop_in_contact(tmp_path: Path) -> None:
    cells = []

    def stop_in_contact(run: TaskRun, now: float) -> Sequence[Command]:
        cells[:] = [run._context.backend]
        pressing = run.tree is not None and run.tree.active.is_pressing
        return (Stop("enough"),) if pressing else ()

    ran = run(RunSpec(task="clean_desk"), Monitor(stop_in_contact))
    (cell,) = cells
    assert ran.result.status == "stopped" and ran.result.sim_time_s > 1.0
    before = cell.data.qpos.copy()
    for _ in range(100):
        cell.advance(TICK_S)
    assert np.abs(cell.data.qpos - before).max() < 1e-3
    assert abs(cell.arm(LAB + "Panda-1").compliance.commanded_wrench).max() < 0.1


@pytest.mark.sim
def test_a_simulation_that_diverges_ends_the_task_and_goes_on_no_more(tmp_path: Path) -> None:
    cells = []

    def tear(run: TaskRun, now: float) -> Sequence[Command]:
        cells[:] = [run._context.backend]
        cells[0].push_hand(LAB + "Iiwa-1", np.array([1e14 if now > 0.5 else 0.0, 0.0, 0.0]))
        return ()

    spec = RunSpec(scene=str(catalogue.scene_path("iiwa_table.ttl")), call="TakePosture(arm: lab:Iiwa-1)")
    ran = run(spec, Monitor(tear), tmp_path / "out")
    result, ended, report = read_ends(tmp_path / "out")
    assert result == ran.result and result.status == ended.status == "failed"
    assert result.failure is not None and "diverged" in result.failure and "diverged" in report
    with pytest.raises(BackendBroken):
        cells[0].advance(TICK_S)


def test_a_task_that_is_paused_and_continued_ends_as_if_it_had_not_been(tmp_path: Path) -> None:
    paused: list[float] = []

    def pause_once(run: TaskRun, now: float) -> Sequence[Command]:
        if run.state == "paused":
            paused.append(now)
            return (Resume(),) if now - paused[0] > 1.0 else ()
        return (PauseRun(),) if run.state == "running" and not paused and now >= 0.5 else ()

    plain = run(request_in(tmp_path, "Lift()"), Monitor()).result
    monitor = Monitor(pause_once)
    result = run(request_in(tmp_path, "Lift()"), monitor).result
    began, ended = (event.time for event in monitor.events if isinstance(event, Paused | Resumed))
    assert result.status == plain.status == "succeeded" and ended - began > 1.0
    assert result.sim_time_s - plain.sim_time_s == pytest.approx(ended - began, abs=5 * TICK_S)
