"""Runs that wait for planners and devices are a queue: by priority, then in the order of their submission."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

import pytest
from msgspec.structs import replace

from execution.loops import LatePlan, staged
from execution.yard import Yard
from skillc_runtime.execution.assignment import NotStarted
from skillc_runtime.execution.device_claims import DeviceClaims
from skillc_runtime.execution.planning_queue import PlanningQueue
from skillc_runtime.recording import commands
from skillc_runtime.recording.run_spec import RunSpec
from tree.library import act
from tree.stage import Script

ROBOTS = {"carl": "a", "dora": "b", "emil": "c"}
DEVICES = frozenset(ROBOTS)


@dataclass
class Entry:
    """A run in the model of the queue, with what it needs; None stands for the whole cell."""

    name: str
    priority: int
    needs: frozenset[str] | None
    runs: bool = False

    @property
    def devices(self) -> frozenset[str]:
        return DEVICES if self.needs is None else self.needs


def may_begin(entry: Entry, queue: list[Entry]) -> bool:
    """The rule: nobody takes a device that another one holds, or that somebody before it waits for."""
    before = queue[: queue.index(entry)]
    return all(entry.devices.isdisjoint(each.devices) for each in queue if each.runs or each in before)


@pytest.mark.parametrize("seed", range(4))
def test_runs_get_devices_by_priority_and_then_in_order(seed: int) -> None:
    chance, claims, queue, waited, began = Random(seed), DeviceClaims(), list[Entry](), 0, 0
    for number in range(3000):
        if len(queue) < 8 and chance.random() < 0.3:
            needs = None if chance.random() < 0.1 else frozenset(chance.sample(sorted(DEVICES), chance.choice((1, 2))))
            entry = Entry(f"run-{number}", chance.choice((-1, 0, 0, 3)), needs)
            queue.append(entry)
            queue.sort(key=lambda each: -each.priority)
            claims.order([each.name for each in queue])
        for entry in tuple(queue):
            if chance.random() < (0.2 if entry.runs else 0.01):
                claims.remove(entry.name)
                queue.remove(entry)
            elif not entry.runs:
                entry.runs = may_begin(entry, queue)
                busy = claims.wait_for(entry.name, entry.needs)
                assert (busy is None) == entry.runs, (number, entry, busy)
                assert busy is None or claims.devices_of(entry.name) == frozenset()
                waited, began = waited + (busy is not None), began + entry.runs
    assert waited > 1000 and began > 300


def test_what_a_running_run_holds_it_needs_not_wait_for_again() -> None:
    claims = DeviceClaims()
    claims.order(("first", "runs"))
    assert claims.wait_for("runs", frozenset({"carl"})) is None
    assert claims.wait_for("first", None) is not None
    assert claims.wait_for("runs", frozenset({"carl"})) is None
    busy = claims.wait_for("runs", frozenset({"carl", "dora"}))
    assert busy is not None and (busy.run, busy.held) == ("first", False)
    assert claims.wait_for("first", None) is None


def test_a_run_says_whom_it_waits_for_and_a_small_one_does_not_overtake() -> None:
    yard = Yard(ROBOTS, {})
    holder, both = yard.submit("lab:carl at lab:d"), yard.submit("lab:carl at lab:b and lab:dora at lab:c")
    small = yard.submit("lab:dora at lab:d")
    yard.tick(2)
    assert both.run.reason.endswith(f"carl, which {holder.run.id} holds")
    assert small.run.reason.endswith(f"dora, after {both.run.id}")
    yard.loop.request(both.run, commands.Stop("enough"))
    yard.tick(2)
    assert small.run.state == "running" and both.run.end == "stopped"


def test_who_waits_can_be_put_first_and_the_others_keep_their_order() -> None:
    yard = Yard(ROBOTS, {})
    holder = yard.submit("lab:carl at lab:d")
    waiting = [yard.submit(f"lab:carl at lab:{place}") for place in "bcd"]
    yard.tick(2)
    yard.loop.reorder([waiting[2].run])
    assert [each for each in yard.loop.runs if each.waits] == [waiting[at].run for at in (2, 0, 1)]
    yard.loop.request(holder.run, commands.Stop("enough"))
    yard.tick(2)
    assert [each.run.state for each in waiting] == ["queued", "queued", "running"]
    assert waiting[1].run.reason.endswith(f"which {waiting[2].run.id} holds")


def test_only_so_many_planners_run_at_once() -> None:
    """What waits for a planner says so, begins by priority, and can be stopped."""
    _, first = staged(act("a"), a=Script(ticks=1))
    loop, started = first.loop, list[str]()
    answers = {name: LatePlan(NotStarted(f"no plan for {name}"), looks=10) for name in "abcd"}

    def start(assignment: object, failures: object) -> LatePlan:
        started.append(assignment.name)  # type: ignore[attr-defined]
        return answers[assignment.name]  # type: ignore[attr-defined]

    loop.close("another planner")
    loop.start_preparation = PlanningQueue(start, limit=1)  # type: ignore[arg-type]
    runs = {
        name: loop.submit(replace(first.run.assignment, name=name), spec=RunSpec(priority=priority))
        for name, priority in (("a", 0), ("b", 0), ("c", 5), ("d", 0))
    }
    loop.tick()
    assert started == ["c"] and runs["c"].waits_for == ""
    assert {each.state for each in runs.values()} == {"planning"}
    assert runs["a"].waits_for == "waits for one of 1 planners"
    loop.request(runs["b"], commands.Stop("enough"))
    for _ in range(60):
        loop.tick()
    assert started == ["c", "a", "d"] and runs["b"].end == "stopped"
    assert runs["d"].failure is not None and runs["d"].failure.message == "no plan for d"
