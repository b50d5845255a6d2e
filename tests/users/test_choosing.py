"""A condition that somebody changes while an arm moves lets another motion of the same arm take over at once."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import pytest

import skillc
from skillc.events import NodeEnded, NodeStarted, WorldChanged

LIBRARY = Path(__file__).with_name("choosing")


@pytest.mark.sim
@pytest.mark.parametrize("backend", ["kinematic", "mujoco"])
def test_a_flag_that_is_set_while_the_arm_moves_left_lets_it_go_right(backend: Literal["kinematic", "mujoco"]) -> None:
    with skillc.start(f"{LIBRARY}:choose", backend=backend, pace=1) as operation:
        for each in operation.events():
            if isinstance(each.event, NodeStarted) and each.event.name == "MoveJoints":
                break
        with operation.edit(who="somebody", why="it changed") as now:
            now.set("lab:Cell", "own:low", True)
        run = operation.wait()
    assert run.status == "succeeded", run.failure
    events = [each.event for each in run.events]
    changed = next(
        each.time for each in events if isinstance(each, WorldChanged) and each.origin.startswith("somebody")
    )
    left, right = (each for each in events if isinstance(each, NodeStarted) and each.name == "MoveJoints")
    ends = {each.node: each for each in events if isinstance(each, NodeEnded)}
    assert (ends[left.node].status, ends[right.node].status) == ("halted", "success")
    assert ends[left.node].time == right.time == changed, "in one tick"
    assert events.index(ends[left.node]) < events.index(right)
