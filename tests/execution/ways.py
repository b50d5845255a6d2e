"""Ways into each state of a task run, on a stage, and what must be true after its end."""

from __future__ import annotations

from itertools import pairwise

from execution.loops import StagedCell, Watched, staged
from skillc_model.skills import Compound, PausePolicy, Skill
from skillc_runtime.execution.task_state import TRANSITIONS
from skillc_runtime.recording import commands
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.events import TaskEnded
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledProperty
from tree.library import ON, Library, act, call, here
from tree.stage import Script

LONG = Script(ticks=500)
SHORT = Script(ticks=5)
FAILS = Script("fail", ticks=5)

APPROVED = RunSpec(approve=True)
ASKING = RunSpec(ask_after_failure=True)
NO_EDIT = commands.EditWorld((), "to see what happens", who="somebody")
EVERY: tuple[Command, ...] = (
    commands.Approve(),
    commands.PauseRun(),
    commands.Resume(),
    commands.StepInto(),
    commands.StepOver(),
    commands.StepOut(),
    commands.Stop("enough"),
    commands.RetryStep(),
    commands.Skip("done by hand", who="somebody"),
    commands.Replan(),
    NO_EDIT,
)


def turned(flag: str, on: bool) -> commands.EditWorld:
    change = LabelledProperty(LabelledIri(flag, flag), LabelledIri(ON, "on"), on)
    return commands.EditWorld((change,), "for the test", who="somebody")


def queued() -> tuple[StagedCell, Watched]:
    return staged(act("a"), looks=(100,), a=LONG)


def planning() -> tuple[StagedCell, Watched]:
    cell, watched = queued()
    return cell, watched.until("planning")


def planned() -> tuple[StagedCell, Watched]:
    cell, watched = staged(act("a"), APPROVED, a=LONG)
    return cell, watched.until("planned")


def running() -> tuple[StagedCell, Watched]:
    cell, watched = staged(act("a"), a=LONG)
    return cell, watched.until("running")


def pausing() -> tuple[StagedCell, Watched]:
    library = Library()
    library.add(Skill(name="Careful", source=here(), pause=PausePolicy(where="never")), Compound(act("a")))
    cell, watched = staged(call("Careful"), library=library, a=LONG)
    watched.until("running").request(commands.PauseRun())
    return cell, watched.until("pausing")


def paused() -> tuple[StagedCell, Watched]:
    cell, watched = running()
    watched.request(commands.PauseRun())
    return cell, watched.until("paused")


def failed_step() -> tuple[StagedCell, Watched]:
    cell, watched = staged(act("a"), ASKING, a=FAILS)
    return cell, watched.until("paused")


def stopping() -> tuple[StagedCell, Watched]:
    cell, watched = staged(act("a"), a=LONG, settle_s=3.0)
    watched.until("running").request(commands.Stop("enough"))
    return cell, watched.until("stopping")


def ended() -> tuple[StagedCell, Watched]:
    cell, watched = staged(act("a"), a=SHORT)
    watched.until_end()
    return cell, watched


WAYS = {
    "queued": queued,
    "planning": planning,
    "planned": planned,
    "running": running,
    "pausing": pausing,
    "paused": paused,
    "after failure": failed_step,
    "stopping": stopping,
    "succeeded": ended,
}


def check_nothing_left(cell: StagedCell, watched: Watched) -> None:
    """Check that nothing runs, is locked, claimed or expected, and that the end was told last."""
    assert isinstance(watched.events[-1], TaskEnded) and len(watched.told(TaskEnded)) == 1
    assert watched.run._context.locks.held == frozenset() == watched.run._claims.devices_of(watched.run.id)
    assert not cell.watchdog.expired(cell.now + 1e6)
    watched.loop.tick()
    told = len(cell.log)
    for _ in range(5):
        assert not watched.loop.tick()
    assert len(cell.log) == told
    entered = watched.states
    assert all(after in TRANSITIONS[before] for before, after in pairwise(entered)), entered
