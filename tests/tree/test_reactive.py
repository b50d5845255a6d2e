"""Reactive nodes look again at what is done and at what failed."""

from __future__ import annotations

from skillc_model import tree
from skillc_model.conditions import Individual
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.world.state.changes import SetProperty
from tree.library import FLAGS, ON, Library, act, call, check, here, is_on, par, sel, seq, world
from tree.stage import Script, Stage

IS_ON = is_on(Individual(FLAGS[0]))
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
