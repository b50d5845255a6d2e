"""A recorded run, repeated from its requests and plans, tells the same; what was changed in a recording is found."""

from __future__ import annotations

import os

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from msgspec import structs

from execution import actors, random_runs
from execution.actors import Acting
from execution.random_runs import DRAWN, Drawn
from execution.yard import CRATE_TO_B, Yard
from plans.depot import library
from skillc_runtime.execution.repeat import Divergence, NotRepeatable, Repetition, repeat_run
from skillc_runtime.execution.task_state import RefusedCommand
from skillc_runtime.recording import commands
from skillc_runtime.recording.events import Event, NodeEnded, PlanArrived, Requested, TaskStarted
from skillc_runtime.recording.run_spec import RunSpec

RUNS = int(os.environ.get("SKILLC_RUNS", "40"))
QUIET = (HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.filter_too_much)
PHASES = (Phase.explicit, Phase.reuse, Phase.generate)


def check(drawn: Drawn) -> None:
    ran = random_runs.run(drawn)
    recorded = ran.watched.events
    Acting.prepare(drawn.play.scripts)
    again = actors.cell()
    repetition = repeat_run(recorded, drawn.play.library, again)
    assert repetition.difference is None, str(repetition.difference)
    assert repetition.events == tuple(recorded)
    assert (actors.postures(again) == actors.postures(ran.cell)).all(), "to the last bit"


@pytest.mark.sim
@settings(max_examples=RUNS, deadline=None, derandomize=True, phases=PHASES, suppress_health_check=QUIET)
@given(DRAWN)
def test_a_repeated_run_tells_the_same(drawn: Drawn) -> None:
    check(drawn)


def carried(crates: str = "a") -> Yard:
    return Yard({"carl": "c"}, {"crate": crates}, fails=lambda step, number: step == "carl crate b" and number == 1)


def recording() -> list[Event]:
    """Return the events of a run that was paused, stepped, replanned, failed, and was retried."""
    run = carried().submit(CRATE_TO_B, RunSpec(ask_after_failure=True, deadline_s=60.0), looks=(7, 3))
    run.until("running")
    refusals: list[RefusedCommand | None] = []
    for command, state in (
        (commands.PauseRun("coffee"), "paused"),
        (commands.Resume(), "running"),
        (commands.RetryStep(), "running"),
        (commands.PauseRun(), "paused"),
        (commands.Replan(), "running"),
        (commands.PauseRun(), "paused"),
        (commands.StepOver(), "paused"),
        (commands.StepInto(), "paused"),
        (commands.Resume(), "paused"),
        (commands.RetryStep(), "running"),
    ):
        refusals.append(run.request(command))
        run.until(state, 4000)
    assert run.until_end() == "succeeded"
    assert [each is None for each in refusals].count(False) == 1
    return run.events


def repeated(events: list[Event], crates: str = "a") -> Repetition:
    yard = carried(crates)
    return repeat_run(events, library(), yard.depot)  # type: ignore[arg-type]


def test_requests_and_plans_take_effect_again_at_their_ticks() -> None:
    events = recording()
    assert len([event for event in events if isinstance(event, PlanArrived)]) == 2
    assert repeated(events) == Repetition(tuple(events), None)


def test_another_library_is_refused() -> None:
    events = recording()
    assert isinstance(events[0], TaskStarted)
    events[0] = structs.replace(events[0], hash="0123456789abcdef")
    with pytest.raises(NotRepeatable, match="the run used the library plans 0123456789ab, and this is plans "):
        repeated(events)


def test_a_recording_without_a_beginning_is_refused() -> None:
    with pytest.raises(NotRepeatable, match="does not begin with the start of a task"):
        repeated(recording()[1:])
    with pytest.raises(NotRepeatable, match="does not begin with the start of a task"):
        repeated([])


def test_a_run_that_was_not_the_first_of_its_cell_is_refused() -> None:
    events = recording()
    events[0] = structs.replace(events[0], time=5.0)
    with pytest.raises(NotRepeatable, match="the run began at 5 s of its cell, and the recording does not"):
        repeated(events)


def difference(events: list[Event], crates: str = "a") -> Divergence:
    found = repeated(events, crates).difference
    assert found is not None
    return found


def find(events: list[Event], kind: type[Event], number: int = 0) -> int:
    return [place for place, event in enumerate(events) if isinstance(event, kind)][number]


@pytest.mark.parametrize("number", [0, 1])
def test_a_missing_plan_is_found_as_nothing_can_follow(number: int) -> None:
    events = recording()
    place = find(events, PlanArrived, number)
    del events[place]
    found = difference(events)
    assert found.number == place + 1 and found.repeated is None
    assert f"event {place + 1} was " in str(found) and str(found).endswith("and is nothing when repeated")


@pytest.mark.parametrize("by", [-1, 1, 10**6])
def test_a_request_at_another_tick_is_found(by: int) -> None:
    events = recording()
    place = find(events, Requested, 1)
    request = events[place]
    assert isinstance(request, Requested)
    events[place] = structs.replace(request, tick=request.tick + by)
    assert difference(events).number in (place, place + 1)


def test_a_missing_request_is_found() -> None:
    events = recording()
    place = find(events, Requested)
    del events[place]
    assert difference(events).number == place + 1


def test_an_edited_event_is_found() -> None:
    events = recording()
    place = find(events, NodeEnded, 3)
    event = events[place]
    assert isinstance(event, NodeEnded)
    events[place] = structs.replace(event, status="failure")
    found = difference(events)
    assert (found.number, found.recorded) == (place + 1, events[place])
    assert found.repeated == event


def test_an_event_too_many_is_found() -> None:
    events = recording()
    assert difference([*events, events[-1]]) == Divergence(len(events) + 1, events[-1], None)


def test_a_world_in_which_the_plan_does_not_work_is_told() -> None:
    with pytest.raises(NotRepeatable, match="a plan of the recording does not work in this cell"):
        repeated(recording(), crates="d")
