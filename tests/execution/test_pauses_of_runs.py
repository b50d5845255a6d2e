"""Pauses and steps of a task run: nested and parallel calls, pause policies, tools that are taken off."""

from __future__ import annotations

from typing import ClassVar

import pytest

from execution.loops import StagedCell, Watched, staged
from execution.ways import LONG, SHORT, check_nothing_left, paused, pausing
from skillc.cli.output.event_lines import EventLines
from skillc_model import tree
from skillc_model.skills import Compound, PausePolicy, Skill
from skillc_runtime.execution.tree.gate import AtSkill, Gate
from skillc_runtime.primitives.primitive import Activity
from skillc_runtime.recording import commands
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import Paused, Resumed, StateChanged
from tree.library import Library, act, call, here, par, seq, with_
from tree.stage import Scripted


def test_pause_holds_everything_until_it_is_resumed() -> None:
    cell, watched = staged(par("all", act("a"), with_("scope", act("b"))), a=SHORT, b=LONG)
    watched.until("running").request(commands.PauseRun("coffee"))
    watched.until("paused")
    assert watched.run.reason == "coffee"
    ticked = cell.said("tick")
    for _ in range(100):
        watched.loop.tick()
    assert cell.said("tick") == ticked and cell.now > 1.0
    watched.request(commands.Resume())
    assert len(cell.said("tick")) == len(ticked) + 2
    assert watched.until_end() == "succeeded"
    assert [len(watched.told(Paused)), len(watched.told(Resumed))] == [1, 1]


def test_a_pause_that_lasts_takes_tools_off_and_they_come_back_before_anything_goes_on() -> None:
    cell, watched = paused()
    for _ in range(250):
        watched.loop.tick()
    assert cell.said("withdraw", "approach") == ["withdraw a"]
    cell.away = {"a"}
    watched.request(commands.Resume())
    for _ in range(10):
        watched.loop.tick()
    assert watched.run.state == "running" and not cell.said("resume")
    watched.request(commands.PauseRun("again"))
    assert watched.until("paused").run.reason == "again"
    watched.request(commands.Resume())
    cell.away = set()
    watched.loop.tick()
    assert cell.said("resume") == ["resume a"]


class Presses(Scripted):
    """Presses on something while it is active."""

    activity: ClassVar[Activity] = "press"


def test_its_events_say_what_becomes_of_a_tool_that_presses() -> None:
    cell, watched = staged(act("a"), library=Library("execution.test_pauses_of_runs:Presses"), a=LONG)
    watched.until("running").request(commands.PauseRun("coffee"))
    for _ in range(300):
        watched.loop.tick()
    cell.away = {"a"}
    for request in (commands.Resume(), commands.PauseRun("again"), commands.Resume()):
        watched.request(request)
        for _ in range(50):
            watched.loop.tick()
    cell.away = set()
    watched.loop.tick()
    said = [(each.state, each.contact) for each in watched.told(StateChanged)]
    first = [("running", "none"), ("pausing", "none"), ("pausing", "kept"), ("paused", "kept"), ("paused", "lifting")]
    off, back = ("paused", "taken-off"), ("running", "approaching")
    again = [("pausing", "lifting"), off]
    assert said[1:] == [*first, off, back, *again, back, ("running", "none")]
    assert watched.run.contact == "none" and len(watched.told(Paused)) == 1
    lines = [
        next(EventLines().format(Envelope(run="a", sequence=1, wall_time_ns=0, event=each)))
        for each in watched.told(StateChanged)
    ]
    assert lines[4].endswith("paused: coffee: the force is kept")
    assert lines[6].endswith("the tool was taken off the surface; it senses contact again before the task goes on")


def test_nothing_is_said_of_a_tool_that_does_not_press() -> None:
    _, watched = paused()
    for _ in range(250):
        watched.loop.tick()
    assert watched.run.tree is not None and watched.run.tree.withdrawn
    assert {each.contact for each in watched.told(StateChanged)} == {"none"}


@pytest.mark.parametrize("when", ["withdrawn", "approaching"])
def test_a_run_whose_tool_was_taken_off_can_be_stopped(when: str) -> None:
    cell, watched = paused()
    for _ in range(250):
        watched.loop.tick()
    if when == "approaching":
        cell.away = {"a"}
        watched.request(commands.Resume())
    watched.request(commands.Stop("enough"))
    assert watched.until_end() == "stopped"
    assert cell.said("halt", "resume") == ["halt a"]
    check_nothing_left(cell, watched)


def nested(policy: PausePolicy | None = None) -> tuple[tree.Node, Library]:
    """Return `a; Outer { b; c }; d`."""
    library = Library()
    skill = Skill(name="Outer", source=here(), pause=policy or PausePolicy())
    library.add(skill, Compound(seq(act("b"), act("c"))))
    return seq(act("a"), call("Outer"), act("d")), library


def stepping(policy: PausePolicy | None = None) -> tuple[StagedCell, Watched]:
    body, library = nested(policy)
    gate = Gate([AtSkill("Outer")])
    cell, watched = staged(body, library=library, gate=gate, **dict.fromkeys("abcd", SHORT))
    watched.until("paused")
    assert watched.run.reason == "breakpoint at Outer" and list(cell.starts) == ["a"]
    return cell, watched


@pytest.mark.parametrize(
    ("steps", "started"),
    [
        ([commands.StepInto()], "a"),
        ([commands.StepInto(), commands.StepInto()], "ab"),
        ([commands.StepInto(), commands.StepOver()], "ab"),
        ([commands.StepInto(), commands.StepOver(), commands.StepOver()], "abc"),
        ([commands.StepOver()], "abc"),
        ([commands.StepInto(), commands.StepOut()], "abc"),
        ([commands.StepOver(), commands.Resume()], "abcd"),
    ],
    ids=lambda each: "+".join(step.name for step in each) if isinstance(each, list) else each,
)
def test_steps_go_to_the_next_call_over_a_call_or_out_of_one(steps: list[Command], started: str) -> None:
    cell, watched = stepping()
    for step in steps:
        assert watched.request(step) is None
        for _ in range(100):
            if watched.run.state in ("paused", "succeeded"):
                break
            watched.loop.tick()
    assert "".join(cell.starts) == started
    watched.loop.request(watched.run, commands.Resume())
    assert watched.until_end() == "succeeded"


def test_breakpoints_are_changed_while_it_runs_or_is_paused() -> None:
    cell, watched = stepping()
    assert watched.request(commands.SetBreakpoints(("Act",))) is None
    assert watched.request(commands.Resume()) is None
    watched.until("paused")
    assert (watched.run.reason, "".join(cell.starts)) == ("breakpoint at Act", "a")
    watched.loop.request(watched.run, commands.Resume())
    watched.loop.request(watched.run, commands.SetBreakpoints(()))
    assert watched.until_end() == "succeeded"
    assert watched.request(commands.SetBreakpoints(("Act",))) is not None, "it has ended"


def test_a_skill_that_is_never_paused_is_finished_first_visibly() -> None:
    cell, watched = pausing()
    assert watched.run.reason == "requested; Careful must be finished or at its next step first"
    for _ in range(100):
        watched.loop.tick()
    assert watched.run.state == "pausing" and not cell.said("pause")
    assert watched.until_end() == "succeeded", "there is no later point"


def test_a_skill_that_is_paused_between_its_steps_goes_on_to_the_next() -> None:
    body, library = nested(PausePolicy(where="between steps"))
    cell, watched = staged(body, library=library, **dict.fromkeys("abcd", SHORT))
    while "b" not in cell.starts:
        watched.loop.tick()
    watched.request(commands.PauseRun())
    watched.until("paused")
    assert list(cell.starts) == ["a", "b"] and cell.said("tick").count("tick b") == 5
    watched.request(commands.Resume())
    assert watched.until_end() == "succeeded"
