"""Children of a parallel node that wait for others: each starts as soon as those have succeeded."""

from __future__ import annotations

from msgspec.structs import replace

from skillc_model import tree
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from tree.library import Library, act, par
from tree.stage import Script, Stage, stage
from tree.test_lifecycle import finish


def crossed() -> tree.Node:
    """Return a body in which c waits for a, d for a and b, e for d: no nesting of series and parallels says that."""
    body = par("all", *map(act, "abcde"))
    assert isinstance(body, tree.Parallel)
    return replace(body, after=((), (), (0,), (0, 1), (3,)))


def starts(cell: Stage) -> dict[str, float]:
    return {name: round(time, 3) for time, what, name in cell.log if what == "start"}


def test_each_child_starts_when_those_that_it_waits_for_have_ended() -> None:
    cell = stage(a=Script(ticks=2), b=Script(ticks=4), c=Script(ticks=9))
    run = TreeRun(crossed(), Library().build(), cell)
    assert finish(run, cell) is Status.SUCCESS
    began = starts(cell)
    ended = {
        name: max(round(time, 3) for time, what, other in cell.log if (what, other) == ("tick", name))
        for name in "abcde"
    }
    assert began["a"] == began["b"] == 0.0
    assert began["c"] == ended["a"] < began["d"] == ended["b"] <= began["e"] == ended["d"]
    assert ended["e"] < ended["c"], "what waits for nobody goes on meanwhile"


def test_a_failure_halts_the_others_and_starts_no_more() -> None:
    cell = stage(a=Script("fail", 2), b=Script(ticks=1000))
    run = TreeRun(crossed(), Library().build(), cell)
    assert finish(run, cell) is Status.FAILURE
    assert set(starts(cell)) == {"a", "b"}
    assert cell.said("halt") == ["halt a", "halt b"]


def test_what_ends_at_once_lets_its_followers_start_in_the_same_tick() -> None:
    cell = stage()
    run = TreeRun(crossed(), Library().build(), cell)
    assert finish(run, cell, ticks=3) is Status.SUCCESS
    assert list(starts(cell)) == ["a", "b", "c", "d", "e"]
