"""Operations in one process: from threads, coroutines and notebooks, several at once, stopped by an interrupt."""

from __future__ import annotations

import asyncio
import os
import signal
import threading
import time
from collections.abc import Callable

import nbformat
import pytest
from nbclient import NotebookClient

import skillc
from skillc.events import PlanArrived, Requested, StateChanged, TaskEnded, WorldChanged
from waiting import LONG_S

TASK = "contact:press_button"
CELLS = (
    "import skillc",
    "skillc.load_library('contact')",
    "skillc.load_library('contact').draw('PressButton')",
    "skillc.plan('contact:press_button')",
    "skillc.open_scene('ur5e_whiteboard').query('SELECT ?x { ?x skiros:contain lab:Eraser-1 }')",
    "run = skillc.run('contact:press_button', backend='kinematic', out='run', film_quality='draft'); run",
    "run.figures[0]",
    "run.film",
    "skillc.open_scene('ur5e_whiteboard')",
    "operation = skillc.start('contact:press_button', backend='kinematic'); (await operation).status",
)

COMPILING = "compiling the control laws, once for this version, for about 20 s\n"
"""What the first run in a fresh checkout says."""


def _execute(cells: tuple[str, ...], folder: object) -> list[nbformat.NotebookNode]:
    """Execute a notebook with these cells, and return the result of each that has one."""
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(each) for each in cells])
    NotebookClient(notebook, timeout=300, startup_timeout=300, resources={"metadata": {"path": str(folder)}}).execute()
    outputs = [output for cell in notebook.cells for output in cell.outputs]
    printed = [output.text for output in outputs if output.output_type == "stream"]
    assert not [each for each in printed if each != COMPILING], "nothing else is printed"
    results = [output for output in outputs if output.output_type != "stream"]
    assert {each.output_type for each in results} == {"execute_result"}
    return [each.data for each in results]


@pytest.mark.sim
def test_a_notebook_shows_libraries_plans_and_tables_and_runs_tasks(tmp_path: object) -> None:
    library, tree, plan, table, run, figure, film, scene, status = _execute(CELLS, tmp_path)
    assert "press_button" in library["text/html"]
    assert tree["image/svg+xml"].count("<rect") > 5
    assert "PressButton" in plan["image/svg+xml"] and "<table" in plan["text/html"]
    assert "lab:Store" in table["text/html"]
    assert "succeeded" in run["text/html"] and "<svg" in run["text/html"]
    assert "image/png" in figure and "<video " in film["text/html"]
    assert scene["text/plain"] == "Scene('ur5e_whiteboard.ttl')"
    assert status["text/plain"] == "'succeeded'"


@pytest.mark.sim
def test_two_runs_at_once_are_the_same_as_one_after_the_other() -> None:
    both = [skillc.start(TASK, seed=seed) for seed in (1, 2)]
    together = [each.wait() for each in both]
    alone = [skillc.run(TASK, seed=seed) for seed in (1, 2)]
    assert [_without_walls(each) for each in together] == [_without_walls(each) for each in alone]


def _without_walls(run: skillc.Run) -> list[object]:
    """Return the events without what depends on the machine: wall times, and the tick at which a plan arrived."""
    assert run.succeeded
    return [(each.sequence, each.event) for each in run.events if not isinstance(each.event, PlanArrived)]


@pytest.mark.sim
def test_commands_are_obeyed_or_refused() -> None:
    with skillc.start(TASK, backend="kinematic", step=True) as operation:
        assert operation.state == "paused" and "step-into" in operation.allowed
        assert operation.step() == "paused"
        with pytest.raises(skillc.RequestError, match="`approve` is not possible while the task is paused"):
            operation.approve()
        with operation.edit("Ada", "it is clean") as now:
            now.set("lab:Ur5e-1", "skiros:Weight", 21.0)
        operation.resume()
        operation.stop("that will do")
    run = operation.wait()
    assert operation.started_at is not None and operation.ended_at is not None
    assert operation.submitted_at <= operation.started_at <= operation.ended_at
    assert operation.failure is not None and operation.failure.kind == "halted" and operation.outputs == ()
    assert run.status == "stopped" and "that will do" in (run.failure or "")
    events = [each.event for each in run.events]
    assert any(isinstance(each, WorldChanged) and each.origin == "Ada: it is clean" for each in events)
    assert any(isinstance(each, Requested) and each.refused for each in events)
    assert isinstance(events[-1], TaskEnded)
    with pytest.raises(skillc.RequestError, match=r"`resume` is refused: .* has stopped"):
        operation.resume()
    operation.stop()


@pytest.mark.sim
def test_a_coroutine_sees_all_events_while_others_go_on() -> None:
    async def count() -> tuple[int, int, skillc.Run]:
        operation, beats, seen = skillc.start(TASK, backend="kinematic"), 0, 0

        async def beat() -> None:
            nonlocal beats
            while not operation.ended:
                beats += 1
                await asyncio.sleep(0.01)

        beating = asyncio.create_task(beat())
        async for each in operation.events(after=2):
            seen += 1
            assert each.sequence == seen + 2
        await beating
        return beats, seen, await operation

    beats, seen, run = asyncio.run(count())
    assert beats > 3 and seen + 2 == len(run.events)
    assert [each.event.state for each in run.events if isinstance(each.event, StateChanged)][-1] == "running"


def _interrupt_when(ready: Callable[[], bool]) -> threading.Thread:
    def wait() -> None:
        for _ in range(6000):
            if ready():
                os.kill(os.getpid(), signal.SIGINT)
                return
            time.sleep(0.01)

    thread = threading.Thread(target=wait)
    thread.start()
    return thread


@pytest.mark.sim
def test_an_interrupt_stops_the_task_safely_before_it_is_raised() -> None:
    operation = skillc.start(TASK)
    interrupting = _interrupt_when(lambda: operation.time_s > 1.0)
    with pytest.raises(KeyboardInterrupt):
        operation.wait()
    interrupting.join(LONG_S)
    assert operation.ended and operation.state == "stopped"
    assert operation.reason == "interrupted" or "interrupted" in operation.reason


@pytest.mark.sim
def test_a_task_runs_in_any_thread_and_the_program_stays_as_it_is() -> None:
    before = (
        dict(os.environ),
        signal.getsignal(signal.SIGINT),
        signal.getsignal(signal.SIGQUIT),
        threading.active_count(),
    )
    runs: list[skillc.Run] = []
    thread = threading.Thread(target=lambda: runs.append(skillc.run(TASK, backend="kinematic")))
    thread.start()
    thread.join(LONG_S)
    assert runs[0].succeeded
    after = (
        dict(os.environ),
        signal.getsignal(signal.SIGINT),
        signal.getsignal(signal.SIGQUIT),
        threading.active_count(),
    )
    assert after == before
