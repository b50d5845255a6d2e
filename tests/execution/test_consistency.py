"""Events of real runs are possible with their library; what was changed in a recording is found where it is."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from msgspec import structs

from execution import random_runs
from execution.actors import Acting
from execution.random_runs import DRAWN, Drawn
from execution.test_repeat import PHASES, QUIET, carried, find, recording
from plans.depot import library
from skillc_runtime.execution.consistency import Inconsistency, check_events
from skillc_runtime.recording.events import (
    Event,
    ImplementationChosen,
    NodeEnded,
    NodeStarted,
    PlanArrived,
    Requested,
    StateChanged,
    TaskEnded,
    TaskStarted,
    WorldChanged,
)


def check(events: list[Event], crates: str = "a") -> Inconsistency | None:
    return check_events(events, library(), carried(crates).depot.world.snapshot())


def change(events: list[Event], kind: type[Event], number: int = 0, **fields: Any) -> Inconsistency:
    place = find(events, kind, number)
    events[place] = structs.replace(events[place], **fields)
    found = check(events)
    assert found is not None
    return found


def test_a_run_that_was_paused_replanned_and_retried_is_possible() -> None:
    events = recording()
    assert check(events) is None
    for length in range(1, len(events), 7):
        assert check(events[:length]) is None, "a run that was cut off is possible too"


@pytest.mark.slow
@settings(max_examples=25, deadline=None, derandomize=True, phases=PHASES, suppress_health_check=QUIET)
@given(DRAWN)
def test_random_runs_are_possible(drawn: Drawn) -> None:
    ran = random_runs.run(drawn)
    Acting.prepare(drawn.play.scripts)
    from execution import actors

    assert check_events(ran.watched.events, drawn.play.library, actors.cell().world.snapshot()) is None


@pytest.mark.parametrize(
    ("kind", "number", "fields", "why"),
    [
        (TaskStarted, 0, {"hash": "0123"}, "the run used the library"),
        (StateChanged, 1, {"state": "stopped"}, "has the end of its task"),
        (NodeStarted, 2, {"node": 9}, "runs already"),
        (NodeStarted, 1, {"parent": 999}, "inside node 999, which does not run"),
        (NodeEnded, 2, {"node": 999}, "(node 999) does not run"),
        (NodeEnded, 0, {"time": 0.0}, "before the event that precedes it"),
        (ImplementationChosen, 0, {"skill": "Fly"}, "no call of Fly"),
        (ImplementationChosen, 0, {"implementation": "by_air"}, "has no implementation by_air"),
        (PlanArrived, 1, {"time": 1e6}, "before the event that precedes it"),
        (Requested, 1, {"time": 0.0}, "before the event that precedes it"),
    ],
)
def test_what_was_changed_is_found(kind: type[Event], number: int, fields: dict[str, Any], why: str) -> None:
    assert why in str(change(recording(), kind, number, **fields))


@pytest.mark.parametrize(
    ("kind", "number", "why"),
    [
        (TaskStarted, 0, "begins with the start of a task"),
        (NodeStarted, 3, "run"),
        (NodeEnded, 3, "run"),
        (WorldChanged, 0, "is false when it"),
    ],
)
def test_an_event_that_is_missing_is_found(kind: type[Event], number: int, why: str) -> None:
    events = recording()
    del events[find(events, kind, number)]
    found = check(events)
    assert found is not None and why in found.why, found


def test_nothing_follows_the_end() -> None:
    events = recording()
    assert isinstance(events[-1], TaskEnded)
    assert check([*events, events[-1]]) == Inconsistency(len(events) + 1, "the task has ended")


def test_a_call_whose_preconditions_do_not_hold_in_the_world_is_found() -> None:
    found = check(recording(), crates="d")
    assert found is not None and "is false when it starts" in found.why
