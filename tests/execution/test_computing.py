"""What takes long is computed beside the ticks: time stands still in lock step, and goes on where it cannot stand."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import pytest

from execution.loops import LatePlanner, StagedCell, Watched, submit
from skillc_runtime.devices.capabilities import BackendCapabilities
from skillc_runtime.execution.assignment import Assignment, ExecuteBody
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.repeat import repeat_run
from skillc_runtime.primitives.computation import Computation, Computing
from skillc_runtime.primitives.compute_here import compute_here
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.recording import commands
from skillc_runtime.recording.events import Event, Note
from skillc_runtime.world.state.labels.labelled import LabelledQuantity
from tree.library import Library, act, call, par, seq, world
from tree.stage import Script, Scripted, Stage

FOR_EVER_S = 10**9
LIBRARY = Library("execution.test_computing:Thinking").build()


class LockStepCell(StagedCell):
    """A stage whose time passes only in calls."""

    @property
    def capabilities(self) -> BackendCapabilities:
        """What it offers."""
        return BackendCapabilities(lock_step=self)

    def advance_period(self) -> None:
        """Let a control period pass."""
        self.advance(0.001)


def double(number: int, after_s: float = 0.0) -> int:
    time.sleep(after_s)
    return 2 * number


def double_once_released(number: int, file: Path) -> int:
    while not file.exists():
        time.sleep(0.005)
    return 2 * number


def refuse(depth: float) -> None:
    raise SkillFailure("there is no room: {depth:.1f mm} are missing", depth=LabelledQuantity(depth, "m"))


def hang() -> None:
    time.sleep(FOR_EVER_S)


def break_down() -> None:
    raise ZeroDivisionError("seven of nine")


WAYS: dict[str, Callable[[], Computation]] = {
    "quick": lambda: Computation(double, (21,)),
    "slow": lambda: Computation(double, (21, Thinking.takes_s)),
    "held": lambda: Computation(double_once_released, (21, Thinking.released)),
    "refuse": lambda: Computation(refuse, (0.003,)),
    "die": lambda: Computation(os._exit, (7,), name="the look for a place"),
    "break": lambda: Computation(break_down),
    "hang": lambda: Computation(hang, name="the look for a place"),
    "hang a while": lambda: Computation(hang, (), 0.2, "the look for a place"),
    "local": lambda: Computation(lambda: 1),
}
"""What a primitive computes, by the first words of its name."""


class Thinking(Scripted):
    """Computes at its start, if its name says so, before it does what its script says."""

    takes_s: ClassVar[float] = 0.2
    released: ClassVar[Path]

    def start(self) -> None:
        super().start()
        if (way := self.name.split(" of ")[0]) in WAYS:
            self.computing = self._think(WAYS[way]())

    def _think(self, wanted: Computation) -> Computing:
        try:
            found = yield wanted
        finally:
            if self.name.endswith("of a stubborn one"):
                raise RuntimeError("it does not want to end")
        yield None
        self.stage.tell(f"found {found}", self.name)


@dataclass
class Thought:
    """A run on a stage, and the stage."""

    stage: Stage
    watched: Watched

    def tick(self, times: int = 1) -> None:
        """Do so many ticks, without waiting for anything."""
        for _ in range(times):
            self.watched.loop.tick()

    @property
    def events(self) -> list[Event]:
        return self.watched.events

    def worker(self) -> int:
        """Return the process that computes."""
        (running,) = self.watched.run.tree._context.computations._running.values()
        return running.worker.pid


@pytest.fixture(autouse=True)
def released(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """Return the file whose existence lets what is held go on."""
    file = tmp_path / "released"
    monkeypatch.setattr(Thinking, "released", file, raising=False)
    return file


def think(body: object, kind: type[StagedCell] = LockStepCell, **scripts: Script) -> Thought:
    """Return a run of a body that was submitted."""
    cell = kind(world(), {name: [script] for name, script in scripts.items()})
    loop = CellLoop(cell, LIBRARY, LatePlanner(LIBRARY))  # type: ignore[arg-type]
    return Thought(cell, submit(loop, Assignment("act", cell.world.snapshot(), ExecuteBody(body))))  # type: ignore[arg-type]


def is_alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_in_lock_step_time_stands_still_until_it_is_computed(released: Path) -> None:
    slow = think(par("all", act("held"), act("other")), other=Script(ticks=5))
    slow.tick(100)
    assert slow.watched.run.computing and slow.watched.loop.is_computing
    assert slow.stage.now == pytest.approx(0.01) and slow.stage.said("tick") == ["tick other"]
    released.touch()
    assert slow.watched.until_end() == "succeeded"
    assert slow.stage.said()[:4] == ["start held", "start other", "tick other", "tick other"]
    assert "found 42 held" in slow.stage.said() and slow.stage.said("halt") == []


def test_how_long_it_takes_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    told, body = [], seq(par("all", act("slow"), act("other")), act("slow"))
    for takes_s in (0.0, 0.2):
        monkeypatch.setattr(Thinking, "takes_s", takes_s)
        thought = think(body, other=Script(ticks=5))
        assert thought.watched.until_end() == "succeeded"
        told.append(thought.events)
    assert told[0] == told[1] and len(told[0]) > 10


def test_where_time_cannot_stand_still_the_others_go_on_and_it_is_not_ticked(released: Path) -> None:
    slow = think(par("all", act("held"), act("other")), StagedCell, other=Script(ticks=10))
    slow.tick(20)
    assert slow.watched.run.computing and not slow.watched.loop.is_computing
    assert slow.stage.now == pytest.approx(0.2) and slow.stage.said() == [
        "start held",
        "start other",
        *10 * ["tick other"],
    ]
    released.touch()
    while slow.watched.run.computing:
        slow.watched.loop.wait(1.0)
    assert slow.watched.until_end() == "succeeded"


@pytest.mark.parametrize("kind", [LockStepCell, StagedCell])
def test_a_stop_ends_it_within_one_tick(kind: type[StagedCell]) -> None:
    endless = think(act("hang"), kind)
    endless.tick(3)
    pid, before = endless.worker(), endless.stage.now
    assert is_alive(pid)
    assert endless.watched.request(commands.Stop("enough")) is None
    assert not is_alive(pid) and endless.stage.said("halt") == ["halt hang"]
    assert endless.watched.until_end() == "stopped" and endless.stage.now <= before + 0.011


def test_what_does_not_want_to_end_is_halted_nevertheless() -> None:
    stubborn = think(act("hang of a stubborn one"))
    stubborn.tick(3)
    pid = stubborn.worker()
    stubborn.watched.request(commands.Stop("enough"))
    assert not is_alive(pid) and stubborn.stage.said("halt") == ["halt hang of a stubborn one"]
    (note,) = stubborn.watched.told(Note)
    assert "could not be halted: RuntimeError: it does not want to end" in note.message


def test_a_pause_lets_it_go_on_and_takes_the_result_afterwards(released: Path) -> None:
    slow = think(act("held"))
    slow.tick(3)
    assert slow.watched.request(commands.PauseRun()) is None
    assert slow.watched.until("paused").run.state == "paused" and not slow.watched.loop.is_computing
    released.touch()
    slow.tick(50)
    assert "found 42 held" not in slow.stage.said()
    assert slow.watched.request(commands.Resume()) is None
    assert slow.watched.until_end() == "succeeded" and "found 42 held" in slow.stage.said()


def test_what_finds_that_it_cannot_start_lets_another_way_be_tried() -> None:
    refused = think(call("Either", name="refuse"))
    assert refused.watched.until_end() == "failed"
    failure = refused.watched.run.failure
    assert failure is not None and len(failure.causes) == 2
    assert all(each.message == "there is no room: 3.0 mm are missing" for each in failure.causes)
    assert refused.stage.said() == ["start refuse", "start refuse"]


@pytest.mark.parametrize(
    ("way", "kind", "message"),
    [
        ("die", "body", "the look for a place was given up: its process ended with code 7"),
        ("hang a while", "body", "the look for a place was given up: it took longer than 0.2 s"),
        ("break", "error", r"break_down: ZeroDivisionError: seven of nine (test_computing.py:"),
        ("local", "error", "cannot be done in another process"),
    ],
)
def test_what_is_not_computed_fails_and_says_why(way: str, kind: str, message: str) -> None:
    broken = think(act(way))
    assert broken.watched.until_end() == "failed"
    failure = broken.watched.run.failure
    assert failure is not None and message in failure.message, failure
    assert failure.kind == kind


def test_nothing_is_left_of_what_was_computed(released: Path) -> None:
    slow = think(seq(act("held"), act("held")))
    slow.tick(3)
    pid = slow.worker()
    released.touch()
    assert slow.watched.until_end() == "succeeded" and not is_alive(pid)


def test_a_run_with_a_stop_in_between_repeats() -> None:
    endless = think(seq(act("slow"), act("hang")))
    while endless.stage.said("start") != ["start slow", "start hang"]:
        if not endless.watched.loop.tick():
            endless.watched.loop.wait(1.0)
    endless.watched.request(commands.Stop("enough"))
    assert endless.watched.until_end() == "stopped"
    repetition = repeat_run(endless.events, LIBRARY, LockStepCell(world()))  # type: ignore[arg-type]
    assert repetition.difference is None and len(repetition.events) == len(endless.events)


def test_without_a_tree_it_is_computed_in_place() -> None:
    there = Stage(world())
    thinking = Thinking(there, name="quick")
    thinking.start()
    compute_here(thinking)
    assert there.said() == ["start quick", "found 42 quick"] and thinking.computing is None
    assert thinking.tick() is Status.SUCCESS
    refusing = Thinking(there, name="refuse")
    refusing.start()
    with pytest.raises(SkillFailure, match=r"3\.0 mm"):
        compute_here(refusing)
    assert isinstance(refusing, Primitive)
