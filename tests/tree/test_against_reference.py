"""The engine does what the plain reference does: the same statuses and words to each primitive at the same time."""

from __future__ import annotations

import os

from hypothesis import HealthCheck, event, given, settings

from skillc_runtime.execution.tree.locks import DeviceLocks
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.world.state.changes import SetProperty
from tree.library import FLAGS, ON, world
from tree.reference import run, unwind
from tree.reference_model import Model, Result, Scope
from tree.stage import PERIOD_S, Stage
from tree.strategies import Play, plays

TICKS = 40
EXAMPLES = int(os.environ.get("SKILLC_TREES", "50"))
"""How many random trees run; thousands on occasion."""


@given(plays())
@settings(max_examples=EXAMPLES, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
def test_the_engine_agrees_with_the_reference(play: Play) -> None:
    statuses, log, failure = by_reference(play)
    stage = Stage(world(), play.scripts)
    locks = DeviceLocks()
    engine = TreeRun(play.body, play.library, stage, locks=locks)
    assert by_engine(play, stage, engine) == statuses
    assert stage.log == log
    assert (engine.failure.kind if engine.failure else "") == failure
    assert not locks.held
    balanced(stage)
    event(f"ended {statuses[-1]} {failure}")


def by_engine(play: Play, stage: Stage, engine: TreeRun) -> list[str]:
    """Return the status after each tick."""
    statuses: list[str] = []
    for number in range(TICKS):
        stage.now = number * PERIOD_S
        stage.world.commit([SetProperty(flag, ON, on) for tick, flag, on in play.switches if tick == number])
        if number == play.halt_at:
            engine.halt("the test says so")
        statuses.append(engine.tick().value)
        if engine.status is not Status.RUNNING:
            return statuses
    engine.halt("enough")
    return [*statuses, engine.status.value]


def by_reference(play: Play) -> tuple[list[str], list[tuple[float, str, str]], str]:
    """Return the status after each tick, the log, and the kind of the failure."""
    model, scope = Model(play.library, play.scripts, dict.fromkeys(FLAGS, True)), Scope()
    life = run(play.body, model, scope)
    statuses: list[str] = []
    result: Result | None = None
    for number in range(TICKS):
        model.now = number * PERIOD_S
        model.flags.update({flag: on for tick, flag, on in play.switches if tick == number})
        if number == play.halt_at:
            break
        try:
            next(life)
            statuses.append("running")
        except StopIteration as end:
            result = end.value
            break
    life.close()
    unwind(model, scope)
    kind = "halted" if result is None else result.kind
    statuses.append({"halted": "halted", "": "success"}.get(kind, "failure"))
    return statuses, model.log, kind


def balanced(stage: Stage) -> None:
    """Check that no primitive was halted or released more often than started."""
    for name in {name for _, _, name in stage.log}:
        said = stage.said()
        assert said.count(f"halt {name}") <= said.count(f"start {name}")
        assert said.count(f"release {name}") <= said.count(f"start {name}")
