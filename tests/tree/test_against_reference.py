"""The engine does what the plain reference does: the same statuses and words to each primitive at the same time."""

from __future__ import annotations

import os
from collections import defaultdict
from typing import NamedTuple

from hypothesis import HealthCheck, event, given, settings

from skillc_model import tree
from skillc_model.traversal import walk
from skillc_runtime.execution.tree.locks import DeviceLocks
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import Event, NodeEnded, NodeStarted
from skillc_runtime.world.state.changes import SetProperty
from tree.library import FLAGS, ON, world
from tree.reference import run, unwind
from tree.reference_model import Model, Result, Scope
from tree.stage import PERIOD_S, Stage
from tree.strategies import Play, plays

TICKS = 40
EXAMPLES = int(os.environ.get("SKILLC_TREES", "50"))
"""How many random trees run; thousands on occasion."""
CONTESTED = int(os.environ.get("SKILLC_TREES", "15"))
ONE_BY_ONE = ("seq", "sel", "reactive seq", "reactive sel")
SLOW = [HealthCheck.too_slow, HealthCheck.data_too_large]


class History(NamedTuple):
    """The status and the locked devices after each tick, what primitives were told, and the kind of the failure."""

    statuses: list[str]
    held: list[frozenset[str]]
    log: list[tuple[float, str, str]]
    failure: str


class Overlaps:
    """A listener that looks for two children of a sequence or selector that are active at once."""

    def __init__(self) -> None:
        self.kinds: dict[int, str] = {}
        self.parents: dict[int, int] = {}
        self.active: dict[int, set[int]] = defaultdict(set)
        self.found: list[NodeStarted] = []

    def __call__(self, told: Event) -> None:
        if isinstance(told, NodeStarted):
            self.kinds[told.node], self.parents[told.node] = told.kind, told.parent
            siblings = self.active[told.parent]
            if siblings and self.kinds.get(told.parent) in ONE_BY_ONE:
                self.found.append(told)
            siblings.add(told.node)
        elif isinstance(told, NodeEnded):
            self.active[self.parents[told.node]].discard(told.node)


@given(plays())
@settings(max_examples=EXAMPLES, suppress_health_check=SLOW)
def test_the_engine_agrees_with_the_reference(play: Play) -> None:
    agree(play)


@given(plays(contested=True))
@settings(max_examples=CONTESTED, suppress_health_check=SLOW)
def test_devices_are_handed_over_in_the_tick_in_which_conditions_flip(play: Play) -> None:
    history = agree(play)
    reactive = any(isinstance(each, tree.Selector | tree.Sequence) and each.reactive for each in walk(play.body))
    event(f"reactive: {reactive}, halted on the way: {halted_on_the_way(history)}")


@given(plays(size=20, crowded=True))
@settings(max_examples=CONTESTED, suppress_health_check=SLOW)
def test_calls_wait_for_devices_in_the_order_in_which_they_came(play: Play) -> None:
    agree(play)


def agree(play: Play) -> History:
    """Run a tree by both; return its history."""
    expected = by_reference(play)
    stage, overlaps = Stage(world(), play.scripts), Overlaps()
    locks = DeviceLocks()
    engine = TreeRun(play.body, play.library, stage, [overlaps], locks)
    assert by_engine(play, stage, engine, locks) == expected
    assert not locks.held and not engine.listener_problems
    assert not overlaps.found
    balanced(stage)
    event(f"ended {expected.statuses[-1]} {expected.failure}")
    return expected


def halted_on_the_way(history: History) -> bool:
    """Whether a primitive was halted, and another one started in the same tick."""
    halts = {when for when, what, _ in history.log if what == "halt"}
    return any(what == "start" and when in halts for when, what, _ in history.log)


def by_engine(play: Play, stage: Stage, engine: TreeRun, locks: DeviceLocks) -> History:
    """Return what the engine does."""
    statuses: list[str] = []
    held: list[frozenset[str]] = []
    for number in range(TICKS):
        stage.now = number * PERIOD_S
        stage.world.commit([SetProperty(flag, ON, on) for tick, flag, on in play.switches if tick == number])
        if number == play.halt_at:
            engine.halt("the test says so")
        statuses.append(engine.tick().value)
        if engine.status is not Status.RUNNING:
            break
        held.append(locks.held)
    else:
        engine.halt("enough")
        statuses.append(engine.status.value)
    return History(statuses, held, stage.log, engine.failure.kind if engine.failure else "")


def by_reference(play: Play) -> History:
    """Return what the reference does."""
    model, scope = Model(play.library, play.scripts, dict.fromkeys(FLAGS, True)), Scope()
    life = run(play.body, model, scope)
    statuses: list[str] = []
    held: list[frozenset[str]] = []
    result: Result | None = None
    for number in range(TICKS):
        model.now = number * PERIOD_S
        model.flags.update({flag: on for tick, flag, on in play.switches if tick == number})
        if number == play.halt_at:
            break
        try:
            next(life)
            statuses.append("running")
            held.append(frozenset(device for device, keys in model.locks.items() if device and keys))
        except StopIteration as end:
            result = end.value
            break
    life.close()
    unwind(model, scope)
    kind = "halted" if result is None else result.kind
    statuses.append({"halted": "halted", "": "success"}.get(kind, "failure"))
    return History(statuses, held, model.log, kind)


def balanced(stage: Stage) -> None:
    """Check that no primitive was halted or released more often than started."""
    for name in {name for _, _, name in stage.log}:
        said = stage.said()
        assert said.count(f"halt {name}") <= said.count(f"start {name}")
        assert said.count(f"release {name}") <= said.count(f"start {name}")
