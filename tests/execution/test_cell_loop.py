"""A loop with several runs: devices, queues, planning beside them, and requests from everywhere."""

from __future__ import annotations

import re
import signal
import threading

import pytest

from execution.loops import staged
from execution.yard import BOX_TO_B, CRATE_TO_B, Yard
from plans.depot import iri
from skillc_runtime.execution.cell_loop import MAX_REQUESTS, TooManyRequests
from skillc_runtime.recording import commands
from skillc_runtime.recording.events import PlanArrived, Requested, StateChanged, TaskEnded
from tree.library import act
from tree.stage import Script
from waiting import LONG_S


def two_robots() -> Yard:
    return Yard({"carl": "a", "dora": "c"}, {"crate": "a", "box": "c"})


def test_runs_on_different_devices_go_on_side_by_side_and_a_third_waits_for_both() -> None:
    yard = two_robots()
    first, second = yard.submit("lab:carl at lab:b"), yard.submit("lab:dora at lab:d")
    third = yard.submit("lab:carl at lab:d and lab:dora at lab:a")
    yard.tick(2)
    assert [each.run.state for each in (first, second, third)] == ["running", "running", "queued"]
    assert re.fullmatch(f"waits for \\S+carl, which {re.escape(first.run.id)} holds", third.run.reason)
    assert first.until_end() == "succeeded" == second.until_end()
    assert third.run.state in ("queued", "running") and yard.depot.now < 5.1
    assert third.until_end() == "succeeded"
    assert yard.depot.log == ["carl a b", "dora c d", "carl b d", "dora d a"] or yard.depot.now < 10.2


def test_the_stop_of_one_run_does_not_concern_the_other() -> None:
    yard = two_robots()
    secured: list[frozenset[str] | None] = []
    yard.depot.secure = lambda devices=None: secured.append(devices) or ()  # type: ignore[method-assign,func-returns-value]
    first, second = yard.submit("lab:carl at lab:b"), yard.submit("lab:dora at lab:d")
    yard.tick(10)
    first.request(commands.Stop("enough"))
    assert first.until_end() == "stopped"
    assert secured == [frozenset({iri("carl")})] and second.run.state == "running"
    assert second.until_end() == "succeeded"
    assert secured[1:] == [frozenset({iri("dora")})]


def test_a_run_that_waits_for_devices_can_be_stopped() -> None:
    yard = two_robots()
    first, second = yard.submit("lab:carl at lab:b"), yard.submit("lab:carl at lab:d")
    yard.tick(10)
    assert second.run.state == "queued"
    second.request(commands.Stop("enough"))
    assert second.run.end == "stopped" and first.until_end() == "succeeded"


def test_runs_that_wait_hold_nothing_so_that_none_waits_for_ever() -> None:
    """Each of two runs first needs one robot, then, after a failure, the other one."""
    yard = Yard(
        {"carl": "a", "dora": "c"},
        {"crate": "a", "box": "c"},
        fails=lambda step, number: step in ("carl crate a", "dora box c"),
    )
    first, second = yard.submit(CRATE_TO_B), yard.submit(BOX_TO_B)
    yard.tick(20)
    assert {first.run.state, second.run.state} == {"running"}
    assert first.until_end() == "succeeded" == second.until_end()
    assert [len(each.run.attempts) for each in (first, second)] == [2, 2]


def test_time_goes_on_for_one_run_while_another_plans() -> None:
    yard = two_robots()
    first, second = yard.submit("lab:carl at lab:b"), yard.submit("lab:dora at lab:d", looks=(0, 100))
    yard.tick(100)
    assert second.run.state == "planning" and yard.depot.now == pytest.approx(1.0)
    yard.tick(1)
    assert second.run.state == "running"
    assert [arrived.tick for arrived in second.told(PlanArrived)] == [100]
    assert first.until_end() == "succeeded" == second.until_end()


def test_stops_have_a_lane_that_no_flood_fills() -> None:
    _, watched = staged(act("a"), a=Script(ticks=500))
    watched.until("running")
    flood = [watched.loop.request(watched.run, commands.Resume()) for _ in range(MAX_REQUESTS)]
    with pytest.raises(TooManyRequests, match=f"{MAX_REQUESTS} requests wait for the next tick; try again later"):
        watched.loop.request(watched.run, commands.Resume())
    stop = watched.loop.request(watched.run, commands.Stop("enough"))
    watched.loop.tick()
    assert stop.answered and stop.refused is None and watched.run.end == "stopped"
    assert all(each.answered and each.refused is not None for each in flood)
    assert isinstance(watched.loop.request(watched.run, commands.Resume()).command, commands.Resume)


def test_requests_that_nobody_will_take_any_more_are_refused_at_the_end() -> None:
    _, watched = staged(act("a"), a=Script(ticks=500))
    watched.until("running")
    request = watched.loop.request(watched.run, commands.PauseRun())
    watched.loop.close("the program ends")
    assert request.answered and request.refused is not None and request.refused.state == "stopped"


def test_one_stop_for_all_stops_all() -> None:
    yard = two_robots()
    runs = [yard.submit("lab:carl at lab:b"), yard.submit("lab:dora at lab:d"), yard.submit("lab:carl at lab:d")]
    yard.tick(10)
    yard.loop.stop("lunch")
    assert {each.until_end() for each in runs} == {"stopped"}
    assert not yard.loop.runs and not yard.loop.tick()


def test_requests_from_other_threads_are_each_answered_once() -> None:
    """Threads command while the loop ticks; every request is answered and told, and the stop of one of them works."""
    _, watched = staged(act("a"), a=Script(ticks=10**9))
    watched.until("running")
    sent: list[list[object]] = [[] for _ in range(4)]

    def command(mine: list[object]) -> None:
        for number in range(200):
            each = commands.PauseRun() if number % 2 else commands.Resume()
            mine.append(watched.loop.request(watched.run, each))

    threads = [threading.Thread(target=command, args=(mine,)) for mine in sent]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        watched.loop.tick()
    stopper = threading.Thread(target=watched.loop.stop, args=("enough", watched.run))
    stopper.start()
    stopper.join(LONG_S)
    assert watched.until_end() == "stopped"
    asked = [request for mine in sent for request in mine]
    assert len(asked) == 800 and all(request.answered for request in asked)  # type: ignore[attr-defined]
    told = watched.told(Requested)
    assert len(told) == 801 and isinstance(watched.events[-1], TaskEnded)


def test_a_signal_handler_may_stop_at_any_moment() -> None:
    """Handlers run in the loop's own thread, between any two instructions of it."""
    _, watched = staged(act("a"), a=Script(ticks=10**9))
    watched.until("running")
    before = signal.signal(signal.SIGALRM, lambda number, frame: handle())
    calls = 0

    def handle() -> None:
        nonlocal calls
        calls += 1
        watched.loop.request(watched.run, commands.PauseRun())
        if calls == 200:
            watched.loop.stop("enough")

    try:
        signal.setitimer(signal.ITIMER_REAL, 0.0005, 0.0005)
        assert watched.until_end(10**7) == "stopped"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    assert calls >= 200


def test_each_request_is_told_with_the_tick_in_which_it_took_effect() -> None:
    _, watched = staged(act("a"), a=Script(ticks=500))
    watched.until("running")
    ticks = []
    for command in (commands.PauseRun(), commands.Resume(), commands.PauseRun()):
        ticks.append(watched.loop.ticks)
        watched.request(command)
    assert [event.tick for event in watched.told(Requested)] == ticks


@pytest.mark.parametrize("offset", range(-2, 3))
@pytest.mark.parametrize("command", [commands.PauseRun(), commands.Stop("enough")], ids=lambda each: each.name)
def test_requests_at_the_tick_at_which_everything_ends(command: commands.Command, offset: int) -> None:
    cell, watched = staged(act("a"), settle_s=0.05, a=Script(ticks=20))
    for _ in range(20 + offset):
        watched.loop.tick()
    watched.loop.request(watched.run, command)
    watched.until_end_or("paused")
    if watched.run.state == "paused":
        watched.request(commands.Resume())
    end = watched.until_end()
    assert end == "stopped" if isinstance(command, commands.Stop) else end == "succeeded"
    assert isinstance(watched.events[-1], TaskEnded) and len(watched.told(TaskEnded)) == 1
    assert cell.said("tick").count("tick a") <= 20


def test_every_state_is_told_as_it_is_entered() -> None:
    yard = Yard({"carl": "c"}, {"crate": "a"})
    run = yard.submit(CRATE_TO_B)
    seen = ["queued"]
    while not run.run.ended:
        yard.tick(1)
        if seen[-1] != run.run.state:
            seen.append(run.run.state)
    assert [event.state for event in run.told(StateChanged)] == ["planning", "running"]
    assert seen == ["queued", "running", "succeeded"]
