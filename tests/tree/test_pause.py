"""What a pause does to a run: time stands still, and primitives pause, withdraw, approach and resume in order."""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest

from skillc_model import tree
from skillc_model.conditions import Literal
from skillc_runtime.devices.cell import Cell
from skillc_runtime.execution.tree.pause import APPROACH_S
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.execution.tree.run_cell import RunCell
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import Event, Listener, Paused, Resumed
from tree.library import Library, act, here, par, seq, with_, world
from tree.stage import PERIOD_S, Script, Scripted, Stage, stage

LONG = Script(ticks=1000)


def test_pause_and_resume_reach_what_runs_and_time_stands_still() -> None:
    cell = stage(a=Script(ticks=2), b=LONG)
    timed = tree.Timeout(seconds=Literal(1.0), child=act("b"), source=here())
    run = TreeRun(par("all", act("a"), timed), Library().build(), cell)
    run.tick()
    run.tick()
    run.pause()
    run.pause()
    cell.now += 100.0
    assert run.tick() is Status.RUNNING and run.paused
    run.resume()
    run.resume()
    assert cell.said("pause", "resume") == ["pause b", "resume b"]
    assert run.tick() is Status.RUNNING
    cell.now += 1.01
    assert run.tick() is Status.FAILURE
    assert run.failure is not None and run.failure.kind == "timeout"


def test_a_paused_run_can_be_halted() -> None:
    cell = stage(a=LONG)
    run = TreeRun(act("a"), Library().build(), cell)
    run.tick()
    run.pause()
    run.halt("enough")
    run.resume()
    assert run.status is Status.HALTED and cell.said() == ["start a", "tick a", "pause a", "halt a"]


class Timed(Scripted):
    """Notes the time that its cell shows when it is ticked."""

    def tick(self) -> Status:
        self.stage.tell(f"{self.cell.now:.1f} s", self.name)
        return Status.RUNNING


def test_the_time_that_primitives_see_stands_still_in_a_pause() -> None:
    cell = stage()
    run = TreeRun(act("a"), Library("tree.test_pause:Timed").build(), cell)
    for at, paused in ((1.0, False), (2.0, True), (7.0, False), (7.5, False), (9.5, True), (9.6, False), (10.0, False)):
        cell.now = at
        if paused:
            run.pause()
        else:
            run.resume()
        run.tick()
    seen = [each for each in cell.said() if each[0].isdigit()]
    assert seen == [
        "1.0 s a",
        "2.0 s a",
        "2.5 s a",
        "4.5 s a",
        "4.9 s a",
    ]


def test_a_primitive_sees_the_devices_of_its_cell_and_nothing_else() -> None:
    cell = stage()
    seen = RunCell(cell)  # type: ignore[arg-type]
    public = {name for name in dir(RunCell) if not name.startswith("_")}
    assert public - {"is_still", "take_fault"} == {name for name in dir(Cell) if not name.startswith("_")} - {"now"}
    assert seen.world is cell.world and seen.now == cell.now
    with pytest.raises(AttributeError):
        seen.scripts  # type: ignore[attr-defined]  # noqa: B018


@dataclass
class Fingers:
    """A gripper that moves as long as the test says."""

    moving: bool = True


@dataclass
class Handed(Stage):
    """A stage with a gripper."""

    fingers: Fingers = field(default_factory=Fingers)

    def gripper(self, individual: str) -> Fingers:
        return self.fingers


class Grips(Scripted):
    """Uses the gripper of its cell."""

    def __init__(self, cell: Stage, **rest: object) -> None:
        super().__init__(cell, **rest)  # type: ignore[arg-type]
        self.cell.gripper("a gripper")


def test_a_run_is_still_when_its_devices_have_been_at_rest_for_a_while() -> None:
    cell = Handed(world(), {"a": [LONG]})
    run = TreeRun(act("a"), Library("tree.test_pause:Grips").build(), cell)
    run.tick()
    assert not run.is_still
    run.pause()
    steps = ((0.1, True, False), (0.25, False, False), (0.1, True, False), (0.25, False, False), (0.1, False, True))
    for seconds, moving, still in steps:
        cell.now += seconds
        cell.fingers.moving = moving
        run.tick()
        assert run.is_still is still
    run.resume()
    assert not run.is_still


def paused_in_scopes(*listeners: Listener) -> tuple[Stage, TreeRun]:
    """Return a paused run of `body` beside `other`, in the scopes of `outer` and `inner`, and its stage."""
    cell = stage(body=LONG, other=LONG)
    body = with_("outer", with_("inner", par("all", act("body"), act("other"))))
    run = TreeRun(body, Library().build(), cell, listeners)
    run.tick()
    run.pause()
    assert cell.said("pause") == ["pause other", "pause body", "pause inner", "pause outer"]
    cell.log.clear()
    return cell, run


def test_a_pause_concerns_what_runs_and_what_is_in_scope() -> None:
    cell, run = paused_in_scopes()
    run.resume()
    assert not run.paused
    assert cell.said() == ["resume outer", "resume inner", "resume body", "resume other"]


def test_it_does_not_concern_what_has_ended_or_was_released() -> None:
    cell = stage(body=LONG)
    run = TreeRun(seq(act("done"), with_("scope", act("quick")), act("body")), Library().build(), cell)
    run.tick()
    run.pause()
    run.withdraw()
    assert cell.said("release", "pause", "withdraw") == ["release scope", "pause body", "withdraw body"]


def test_what_was_withdrawn_approaches_in_order_before_anything_goes_on() -> None:
    cell, run = paused_in_scopes()
    run.withdraw()
    run.withdraw()
    assert run.withdrawn and cell.said() == ["withdraw other", "withdraw body", "withdraw inner", "withdraw outer"]
    cell.log.clear()
    cell.away = {"inner"}
    run.resume()
    run.resume()
    for _ in range(3):
        assert run.tick() is Status.RUNNING and run.paused
    assert cell.said() == ["approach outer", "approach inner"] * 3
    cell.log.clear()
    cell.away = set()
    assert run.tick() is Status.RUNNING and not run.paused and not run.withdrawn
    order = ("outer", "inner", "body", "other")
    assert cell.said() == [f"approach {name}" for name in order] + [f"resume {name}" for name in order]


def test_a_pause_while_tools_approach_withdraws_them_again() -> None:
    cell, run = paused_in_scopes()
    cell.away = {"inner"}
    run.withdraw()
    run.resume()
    run.tick()
    cell.log.clear()
    run.pause()
    assert run.withdrawn and cell.said()[0] == "withdraw other"
    cell.log.clear()
    cell.away = set()
    run.tick()
    assert run.paused and cell.said() == []
    run.resume()
    run.tick()
    assert not run.paused and cell.said("resume")


def test_a_tool_that_finds_no_contact_again_fails_the_run() -> None:
    cell, run = paused_in_scopes()
    cell.away = {"outer"}
    run.withdraw()
    run.resume()
    cell.now += APPROACH_S
    assert run.tick() is Status.RUNNING
    cell.now += PERIOD_S
    assert run.tick() is Status.FAILURE
    assert run.failure is not None
    assert run.failure.message == "Scripted was not in contact again within 30 s of the end of the pause"
    assert cell.said("halt", "release") == ["halt other", "halt body", "release inner", "release outer"]


@pytest.mark.parametrize("until", ["paused", "withdrawn", "approaching"])
def test_halting_in_a_pause_gives_everything_back(until: str) -> None:
    cell, run = paused_in_scopes()
    cell.away = {"inner"}
    if until != "paused":
        run.withdraw()
    if until == "approaching":
        run.resume()
        run.tick()
    run.halt("enough")
    run.resume()
    run.withdraw()
    run.tick()
    assert run.status is Status.HALTED and not run.paused
    assert cell.said("halt", "release", "resume") == ["halt other", "halt body", "release inner", "release outer"]


def test_the_events_say_from_when_to_when_the_time_of_the_run_stood_still() -> None:
    told: list[Event] = []
    cell, run = paused_in_scopes(told.append)
    cell.away = {"inner"}
    run.withdraw()
    cell.now = 5.0
    run.resume()
    run.tick()
    cell.now, cell.away = 6.0, set()
    run.tick()
    pauses = [event for event in told if isinstance(event, Paused | Resumed)]
    assert pauses == [Paused(time=0.0), Resumed(time=6.0)]
