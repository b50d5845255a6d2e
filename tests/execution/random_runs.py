"""Random tasks on a kinematic cell with random requests at random ticks, and what must be true of each."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from operator import itemgetter

from hypothesis import strategies as st

from execution import actors
from execution.actors import Acting, check_rest
from execution.loops import LatePlanner, Watched
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import Assignment, ExecuteBody
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.task_state import ALLOWED, ALLOWED_AFTER_FAILURE, TRANSITIONS, RefusedCommand
from skillc_runtime.execution.tree.gate import AtSkill, Gate
from skillc_runtime.recording import commands
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import Event, NodeEnded, Requested, StateChanged, TaskEnded, WorldChanged
from skillc_runtime.recording.publisher import Publisher
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledProperty
from tree.library import FLAGS, ON
from tree.strategies import Play, plays

MOST_TICKS = 400
"""After so many ticks every run is stopped."""

STEPS: tuple[Command, ...] = (commands.StepInto(), commands.StepOver(), commands.StepOut())
OTHERS: tuple[Command, ...] = (
    commands.Approve(),
    commands.RetryStep(),
    commands.Skip("done by hand", who="Ann"),
    commands.Replan(),
    commands.Stop("enough"),
)


def edit(flag: str, on: bool) -> commands.EditWorld:
    """Return the request to turn a flag."""
    change = LabelledProperty(LabelledIri(flag, flag), LabelledIri(ON, "on"), on)
    return commands.EditWorld((change,), "for the test", who="Ann")


ANY_COMMAND = st.one_of(
    st.just(commands.PauseRun()),
    st.just(commands.Resume()),
    st.sampled_from(STEPS),
    st.sampled_from(OTHERS),
    st.builds(edit, st.sampled_from(FLAGS[:2]), st.booleans()),
)


@dataclass(frozen=True)
class Drawn:
    """A task, how it is run, and what is requested before which tick of the driver."""

    play: Play
    settings: RunSpec
    looks: int
    breakpoints: tuple[str, ...]
    requests: tuple[tuple[int, Command], ...]


SETTINGS = st.builds(
    RunSpec,
    approve=st.booleans(),
    deadline_s=st.sampled_from((None, None, 0.3, 2.0)),
    ask_after_failure=st.booleans(),
    step_deadline_s=st.sampled_from((None, None, None, 0.1)),
)
TICKS = st.one_of(st.integers(0, 20), st.integers(0, 300))
DRAWN = st.builds(
    Drawn,
    plays(6, "execution.actors:Acting"),
    SETTINGS,
    st.integers(0, 3),
    st.lists(st.sampled_from(("Act", "Set", "Kept")), max_size=1).map(tuple),
    st.lists(st.tuples(TICKS, ANY_COMMAND), max_size=14).map(lambda found: tuple(sorted(found, key=itemgetter(0)))),
)


@dataclass
class Ran:
    """A run that has ended, its cell and envelopes."""

    watched: Watched
    cell: KinematicCell | SimulatedCell
    envelopes: list[Envelope]
    commits: Counter[str]


def run(drawn: Drawn) -> Ran:
    """Run what was drawn to its end."""
    Acting.prepare(drawn.play.scripts)
    cell, library = actors.cell(), drawn.play.library
    ran = Ran(None, cell, [], Counter())  # type: ignore[arg-type]
    count_commits(cell, ran.commits)
    loop = CellLoop(cell, library, LatePlanner(library, [drawn.looks]))
    assignment = Assignment("act", cell.world.snapshot(), ExecuteBody(drawn.play.body))
    gate = Gate(map(AtSkill, drawn.breakpoints))
    drive(ran, loop, assignment, drawn.settings, gate, drawn.requests, MOST_TICKS)
    return ran


def drive(
    ran: Ran,
    loop: CellLoop,
    assignment: Assignment,
    settings: RunSpec,
    gate: Gate,
    requests: Sequence[tuple[int, Command]],
    most_ticks: int,
) -> None:
    """Run a task, with requests before given ticks, to its end; it is stopped after `most_ticks`."""
    events: list[Event] = []
    publish = Publisher("run", [ran.envelopes.append])
    ran.watched = Watched(loop, loop.submit(assignment, [events.append, publish], settings, gate, "run"), events)
    check_requests(ran)
    waiting, tick = deque(requests), 0
    while tick < most_ticks and not ran.watched.run.ended:
        while waiting and waiting[0][0] <= tick:
            loop.request(ran.watched.run, waiting.popleft()[1])
        # No time passes while skills compute, whatever the speed of the machine.
        tick += not loop.is_computing
        ran.watched.tick()
    if not ran.watched.run.ended:
        loop.stop("time is up", ran.watched.run)
    ran.watched.until_end(600)


def count_commits(cell: KinematicCell | SimulatedCell, commits: Counter[str]) -> None:
    """Count the writes to the world model by their origin."""
    commit = cell.world.commit

    def counted(changes, origin="", *rest):
        commits[origin] += 1
        return commit(changes, origin, *rest)

    cell.world.commit = counted  # type: ignore[method-assign]


def check_requests(ran: Ran) -> None:
    """Check with each request that the run gets that it is allowed, or changes nothing."""
    watched, world = ran.watched, ran.cell.world
    task, obey = watched.run, watched.run.request

    def look() -> tuple[object, ...]:
        return task.state, task.reason, task.allowed, world.snapshot(), len(Acting.told), len(task.attempts)

    def checked(command: Command, tick: int) -> RefusedCommand | None:
        before, allowed, told, over = look(), task.allowed, len(watched.events), task.ended
        refused = obey(command, tick)
        new = watched.events[told:]
        if refused is None:
            assert command.name in allowed
        else:
            assert look() == before and len(new) == (not over)
            assert all(isinstance(event, Requested) and event.refused == str(refused) for event in new)
        return refused

    task.request = checked  # type: ignore[method-assign]


def check(ran: Ran) -> None:
    """Check all that must be true after the end of a run."""
    check_primitives()
    check_facts(ran)
    check_end(ran)


def check_end(ran: Ran) -> None:
    """Check what must be true after the end of any task: events, locks, claims, heartbeats, rest."""
    check_events(ran)
    task = ran.watched.run
    assert task._context.locks.held == frozenset() == task._claims.devices_of(task.id)
    assert not ran.cell.watchdog.expired(ran.cell.now + 1e6)
    check_rest(ran.cell)
    assert not ran.watched.loop.tick()


def check_events(ran: Ran) -> None:
    """Check numbers, times, states, and the end."""
    events = ran.watched.events
    assert [envelope.sequence for envelope in ran.envelopes] == list(range(1, len(events) + 1))
    assert [envelope.event for envelope in ran.envelopes] == events
    assert all(one.time <= other.time for one, other in pairwise(events))
    assert isinstance(events[-1], TaskEnded) and len(ran.watched.told(TaskEnded)) == 1
    states = ["queued", *ran.watched.states]
    assert all(after in TRANSITIONS[before] for before, after in pairwise(states)), states
    state = "queued"
    for event in events:
        match event:
            case Requested(command=command, refused=""):
                assert command.name in (*ALLOWED[state], *(ALLOWED_AFTER_FAILURE if state == "paused" else ()))
            case StateChanged():
                state = event.state
    ticks = [event.tick for event in ran.watched.told(Requested)]
    assert ticks == sorted(ticks)


def check_primitives() -> None:
    """Check that each was halted or succeeded once if it was started, and that scoped ones were released once."""
    for told in Acting.told:
        ends = [call for call in told.calls if call in ("halt", "success")]
        refused = Acting.scripts[told.name] and "halt" not in ends and "success" not in ends
        assert len(ends) == 1 or (refused and told.calls in ([], ["start"])), told
        assert told.calls.count("release") <= 1, told
        after = told.calls[told.calls.index(ends[0]) + 1 :] if ends else []
        if "release" not in told.calls:
            assert not after, told
        else:
            assert told.calls[-1] == "release", told


def check_facts(ran: Ran) -> None:
    """Check that the posts of each call that succeeded were applied once, and edits once."""
    ended = Counter(
        event.name.partition("[")[0]
        for event in ran.watched.told(NodeEnded)
        if event.status == "success" and event.name.startswith("Set[")
    )
    assert ran.commits["Set"] == ended["Set"]
    edits = [e for e in ran.watched.told(Requested) if isinstance(e.command, commands.EditWorld) and not e.refused]
    assert ran.commits["Ann: for the test"] == len(edits)
    assert len([e for e in ran.watched.told(WorldChanged) if e.origin == "Ann: for the test"]) <= len(edits)
