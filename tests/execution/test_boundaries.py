"""What ends exactly when its time is over is in time, however many ticks have added up to that time."""

from __future__ import annotations

from typing import Any

import pytest

from execution.loops import StagedCell, Watched, staged
from skillc_model import tree
from skillc_model.conditions import Literal
from skillc_runtime.execution.attempt import TICK_S
from skillc_runtime.recording.run_spec import RunSpec
from tree.library import here

LATE = {
    "timeout": "wait was not done after",
    "deadline_s": "the task exceeded its deadline of",
    "step_deadline_s": "wait was not done after",
}


def waiting(ticks: int, limit: str, limit_ticks: int, since: float) -> tuple[StagedCell, Watched]:
    """Return a run that begins at a time and waits for so many ticks, with a limit of as many ticks or fewer."""
    wait: tree.Node = tree.Wait(seconds=Literal(ticks * TICK_S), source=here())
    limit_s = limit_ticks * TICK_S
    settings: dict[str, Any] = {} if limit == "timeout" else {limit: limit_s}
    if limit == "timeout":
        wait = tree.Timeout(seconds=Literal(limit_s), child=wait, source=here())
    return staged(wait, RunSpec(**settings), since_s=since)


@pytest.mark.parametrize("limit", LATE)
@pytest.mark.parametrize("ticks", [1, 7, 100, 6000])
@pytest.mark.parametrize("since", [0.0, 36000.1])
def test_a_wait_may_take_all_of_its_time(limit: str, ticks: int, since: float) -> None:
    cell, run = waiting(ticks, limit, ticks, since)
    assert run.until_end() == "succeeded", run.run.failure
    assert cell.now - since == pytest.approx(ticks * TICK_S, abs=TICK_S / 100)


@pytest.mark.parametrize("limit", LATE)
@pytest.mark.parametrize("ticks", [1, 7, 100, 6000])
@pytest.mark.parametrize("since", [0.0, 36000.1])
def test_it_may_not_take_a_tick_more(limit: str, ticks: int, since: float) -> None:
    _, run = waiting(ticks + 1, limit, ticks, since)
    assert run.until_end() == "failed"
    assert run.run.failure is not None and run.run.failure.message.startswith(LATE[limit])
