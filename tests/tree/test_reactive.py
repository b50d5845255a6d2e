"""Reactive nodes look again at what is done and at what failed."""

from __future__ import annotations

from skillc_model import tree
from skillc_model.conditions import Individual
from skillc_runtime.execution.device_claims import ClaimedLocks, DeviceClaims
from skillc_runtime.execution.tree.locks import DeviceLocks
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import Event
from skillc_runtime.world.state.changes import SetProperty
from tree.library import DEVICES, FLAGS, ON, Library, act, call, check, here, is_on, par, sel, seq, with_, world
from tree.stage import Script, Stage

IS_ON = is_on(Individual(FLAGS[0]))
DEVICE = DEVICES[0]
LONG = Script(ticks=1000)


def switched(body: tree.Node, cell: Stage, on: bool) -> TreeRun:
    """Tick twice, switch the first flag, tick again."""
    run = TreeRun(body, Library().build(), cell)
    run.tick()
    run.tick()
    cell.world.commit([SetProperty(FLAGS[0], ON, on)])
    run.tick()
    return run


def test_a_finished_child_starts_anew_when_its_post_no_longer_holds() -> None:
    cell = Stage(world(), {"b": [LONG]})
    set_on = call("Set", name="a", flag=FLAGS[0], value=True)
    run = switched(seq(set_on, act("b"), reactive=True), cell, on=False)
    assert cell.said("start", "halt") == ["start a", "start b", "halt b", "start a", "start b"]
    assert run.status is Status.RUNNING and cell.world.snapshot().value(FLAGS[0], ON) is True


def test_what_comes_after_a_child_that_runs_again_is_halted() -> None:
    cell = Stage(world(), {"a": [Script(), LONG], "b": [LONG]})
    set_on = call("Set", name="a", flag=FLAGS[0], value=True)
    switched(seq(set_on, act("b"), reactive=True), cell, on=False)
    assert cell.said("start", "halt") == ["start a", "start b", "halt b", "start a"]


def test_a_child_whose_post_holds_is_left_alone() -> None:
    cell = Stage(world(), {"b": [LONG]})
    set_off = call("Set", name="a", flag=FLAGS[0], value=False)
    switched(seq(set_off, act("b"), reactive=True), cell, on=False)
    assert cell.said("start", "halt") == ["start a", "start b"]


def test_a_condition_is_looked_at_again() -> None:
    cell = Stage(world(), {"b": [LONG]})
    run = switched(seq(check(FLAGS[0]), act("b"), reactive=True), cell, on=False)
    assert run.status is Status.FAILURE and cell.said() == ["start b", "tick b", "tick b", "halt b"]


def test_with_memory_it_is_not() -> None:
    cell = Stage(world(), {"b": [LONG]})
    run = switched(seq(check(FLAGS[0]), act("b")), cell, on=False)
    assert run.status is Status.RUNNING and cell.said("halt") == []


def test_an_earlier_alternative_that_becomes_possible_takes_over() -> None:
    cell = Stage(world(), {"b": [LONG]})
    cell.world.commit([SetProperty(FLAGS[0], ON, False)])
    run = switched(sel(seq(check(FLAGS[0]), act("a")), act("b"), reactive=True), cell, on=True)
    assert run.status is Status.SUCCESS and cell.said("start", "halt") == ["start b", "halt b", "start a"]


def test_what_an_earlier_start_left_behind_does_not_count() -> None:
    """At its second start the first child decides; that the second would now end otherwise is no reason for a third."""
    cell = Stage(world(), {"a": [Script(ticks=2), Script()], "c": [LONG]})
    turn_off = call("Set", name="b", flag=FLAGS[0], value=False)
    fetch = par("any", act("a"), tree.If(condition=IS_ON, text="on", then=turn_off, orelse=None, source=here()))
    run = TreeRun(seq(fetch, act("c"), reactive=True), Library().build(), cell)
    for _ in range(4):
        run.tick()
    assert cell.said("start") == ["start a", "start b", "start c", "start a", "start c"]


def guarded(*children: tree.Node) -> tree.Node:
    """Return a sequence that begins with a check of the first flag."""
    return seq(check(FLAGS[0]), *children)


def dark(**scripts: Script) -> Stage:
    """Return a stage on which the first flag is off."""
    cell = Stage(world(), {name: [script] for name, script in scripts.items()})
    cell.world.commit([SetProperty(FLAGS[0], ON, False)])
    return cell


def switch(cell: Stage, run: TreeRun, on: bool) -> None:
    """Switch the first flag, and tick."""
    cell.world.commit([SetProperty(FLAGS[0], ON, on)])
    run.tick()


def test_branches_that_use_one_device_hand_it_over_in_one_tick() -> None:
    cell, library, locks = dark(a=LONG, b=LONG), Library(), DeviceLocks()
    inner = library.using(guarded(call("Use", name="a", device=DEVICE)))
    body = sel(call(inner, device=DEVICE), call("Use", name="b", device=DEVICE), reactive=True)
    run = TreeRun(body, library.build(), cell, locks=locks)
    run.tick()
    run.tick()
    switch(cell, run, on=True)
    assert cell.said()[-4:] == ["tick b", "halt b", "start a", "tick a"]
    assert locks.held == {DEVICE}


def test_a_try_is_not_recorded_and_takes_no_number() -> None:
    cell, library, events = dark(a=LONG, b=LONG), Library(), list[Event]()
    inner = library.using(guarded(act("a")))
    run = TreeRun(sel(call(inner, device=DEVICE), act("b"), reactive=True), library.build(), cell, [events.append])
    run.tick()
    told, number = len(events), run.last_node
    for _ in range(5):
        run.tick()
    assert (len(events), run.last_node) == (told, number)


def test_a_branch_that_could_start_and_fails_does_not_halt_the_next_one_again() -> None:
    cell = dark(a=Script("refuse"), b=LONG)
    run = TreeRun(sel(guarded(act("a")), act("b"), reactive=True), Library().build(), cell)
    run.tick()
    switch(cell, run, on=True)
    run.tick()
    once = ["start b", "halt b", "start a", "start b"]
    assert cell.said("start", "halt") == once
    switch(cell, run, on=False)
    switch(cell, run, on=True)
    assert cell.said("start", "halt") == [*once, *once[1:]]


def test_a_device_that_another_run_holds_is_neither_taken_nor_claimed_by_a_try() -> None:
    cell, claims = dark(a=LONG, b=LONG), DeviceClaims()
    claims.order(("own", "other"))
    claims.claim("other", frozenset({DEVICE}))
    body = sel(guarded(call("Use", name="a", device=DEVICE)), act("b"), reactive=True)
    run = TreeRun(body, Library().build(), cell, locks=ClaimedLocks(claims, "own", lambda each: True))
    run.tick()
    switch(cell, run, on=True)
    assert cell.said("start", "halt") == ["start b"]
    assert claims.devices_of("own") == frozenset()
    claims.remove("other")
    run.tick()
    assert cell.said("start", "halt") == ["start b", "halt b", "start a"]
    assert claims.devices_of("own") == {DEVICE}


def test_what_is_set_up_is_undone_before_another_branch_starts() -> None:
    cell = dark(a=LONG, b=LONG)
    run = TreeRun(sel(guarded(act("a")), with_("set-up", act("b")), reactive=True), Library().build(), cell)
    run.tick()
    switch(cell, run, on=True)
    assert cell.said("halt", "release", "start")[-3:] == ["halt b", "release set-up", "start a"]
