"""Nobody waits for ever for a planner, or for an approval."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import pytest

from execution.test_planning_job import hanging_planners, runs
from running_cells.test_operations import run_all
from running_cells.yard import write_yard
from skillc.cells.host import CellHost
from skillc.cells.opening import open_cell
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.execution.planning_job import PlanningJob
from skillc_runtime.planning.progress import PlanningProgress
from waiting import wait_until

LOAD = OperationRequest(call="Load(cart: lab:Cart-1, crate: lab:crate-1)")


def tick(host: CellHost) -> None:
    if not host.tick():
        host.loop.wait(0.01)


def run_until_ended(host: CellHost, operation: str) -> OperationStatus:
    """Tick until an operation has ended; return how. It has to end while others go on."""
    found = list[OperationStatus]()

    def has_ended() -> bool:
        tick(host)
        found.extend(each for each in host.take_changed() if each.id == operation)
        return operation not in host._operations

    wait_until(has_ended)
    return found[-1]


def reported(host: CellHost, operation: str) -> PlanningProgress | None:
    """Return how far its planner is, as the cell reports it."""
    told = [each for each in host.take_changed() if each.id == operation]
    return told[-1].planning if told else None


def test_a_planner_that_hangs_is_ended_and_holds_up_no_other_operation(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    planners, pid = hanging_planners(tmp_path)
    job = partial(PlanningJob, find_planners=lambda: planners, deadline_s=8.0)
    monkeypatch.setattr("skillc.cells.host.PlanningJob", job)
    with open_cell(write_yard(tmp_path, takes_ms=10), SilentReporter()) as host:
        host.submit("hangs", OperationRequest(task="carry_all"))
        wait_until(lambda: host.tick() or pid.exists())
        wait_until(pid.exists)
        wait_until(lambda: host.tick() or reported(host, "hangs") is not None)
        host.submit("goes", LOAD)
        assert run_until_ended(host, "goes").state == "succeeded"
        assert host.loop.runs[0].state == "planning"
        (ended,) = run_all(host)
    assert ended.id == "hangs" and ended.state == "failed" and "time" in ended.reason and ended.planning is None
    wait_until(lambda: not runs(int(pid.read_text())))


@pytest.mark.parametrize("wait", ["planned", "paused"])
def test_nobody_waits_for_ever_for_a_person(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, wait: str) -> None:
    monkeypatch.setattr("skillc_runtime.execution.task_run.DECISION_LIMIT_S", 3.0)
    request = OperationRequest(task="carry_all", approve=wait == "planned", step=wait == "paused")
    with open_cell(write_yard(tmp_path, takes_ms=10), SilentReporter()) as host:
        host.submit("waits", request)
        wait_until(lambda: tick(host) or host.loop.runs[0].state == wait)
        host.submit("goes", LOAD)
        ended = {each.id: each for each in run_all(host)}
    assert ended["waits"].state == "failed" and "nobody has decided for 3 s" in ended["waits"].reason
    assert ended["goes"].state == "succeeded", "it has the cart then"


def test_an_approval_that_never_comes_ends_with_the_deadline(tmp_path: Path) -> None:
    with open_cell(write_yard(tmp_path, takes_ms=10), SilentReporter()) as host:
        host.submit("waits", OperationRequest(task="carry_all", approve=True, deadline_s=8.0))
        host.submit("goes", LOAD)
        assert run_until_ended(host, "goes").state == "succeeded"
        (ended,) = run_all(host)
    assert ended.state == "failed" and "8 s" in ended.reason
