"""Where a run may pause: breakpoints, steps, and what the pause lines of skills say."""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest

from skillc_model import tree
from skillc_model.skills import KEEP_S, Compound, PausePolicy, Skill
from skillc_runtime.execution.tree.gate import AtLine, AtSkill, Breakpoint, Gate, StepKind, keep_s
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from tree.library import Library, act, call, here, par, seq, world
from tree.stage import PERIOD_S, Script, Stage


@dataclass
class Debugged:
    """A run with a gate on a stage where each name takes three ticks."""

    body: tree.Node
    library: Library = field(default_factory=Library)
    breakpoints: tuple[Breakpoint, ...] = ()
    confirms_steps: bool = False

    def __post_init__(self) -> None:
        self.stage = Stage(world(), {name: [Script(ticks=3)] for name in "abcdefg"})
        self.gate = Gate(self.breakpoints, self.confirms_steps)
        self.run = TreeRun(self.body, self.library.build(), self.stage, gate=self.gate)

    def tick(self, ticks: int = 30) -> str:
        """Tick until a pause is possible or the run ends; return what has been started, in order."""
        for _ in range(ticks):
            if self.run.tick() is not Status.RUNNING:
                break
            self.stage.now += PERIOD_S
            if self.gate.reason is not None and self.gate.find_hindrance(self.run.active_calls) is None:
                break
        return "".join(line.removeprefix("start ") for line in self.stage.said("start"))

    def step(self, kind: StepKind) -> str:
        """Make one step and return what has been started."""
        self.gate.step(kind, self.run.active_calls)
        return self.tick()


def nested(*, outer: PausePolicy | None = None, inner: PausePolicy | None = None) -> tuple[tree.Node, Library]:
    """Return `a; Outer { b; Inner { c; d }; e }; f`."""
    library = Library()
    inside = Skill(name="Inner", source=here(), pause=inner or PausePolicy())
    library.add(inside, Compound(seq(act("c"), act("d"))))
    around = Skill(name="Outer", source=here(), pause=outer or PausePolicy())
    library.add(around, Compound(seq(act("b"), call("Inner"), act("e"))))
    return seq(act("a"), call("Outer"), act("f")), library


def test_who_confirms_steps_is_waited_for_before_each_call_that_no_other_one_is_around() -> None:
    body, library = nested()
    debugged = Debugged(body, library, confirms_steps=True)
    for started, step in (("", "Act"), ("a", "Outer"), ("abcde", "Act")):
        assert debugged.tick() == started and debugged.gate.reason == f"{step} is to be confirmed"
        debugged.gate.open()
    assert debugged.tick() == "abcdef" and debugged.run.status is Status.SUCCESS


def test_without_a_gate_and_with_an_open_one_a_run_is_the_same() -> None:
    body, library = nested()
    debugged = Debugged(body, library)
    plain = Stage(world(), dict(debugged.stage.scripts))
    run = TreeRun(body, library.build(), plain)
    while run.tick() is Status.RUNNING:
        plain.now += PERIOD_S
    assert debugged.tick(100) == "abcdef" and debugged.run.status is Status.SUCCESS
    assert debugged.stage.log == plain.log


def test_steps_go_into_over_and_out_of_calls() -> None:
    debugged = Debugged(*nested())
    debugged.gate.step("into", ())
    assert debugged.tick() == ""  # a waits
    assert debugged.step("over") == "a"  # Outer waits
    assert debugged.step("into") == "a"  # b waits
    assert debugged.step("over") == "ab"  # Inner waits
    assert debugged.step("into") == "ab"  # c waits
    assert debugged.step("out") == "abcd"  # e waits
    assert debugged.step("out") == "abcde"  # f waits
    assert debugged.step("over") == "abcdef"
    assert debugged.run.status is Status.SUCCESS


def test_stepping_over_a_call_with_a_body_runs_all_of_it() -> None:
    debugged = Debugged(*nested())
    debugged.gate.step("into", ())
    debugged.tick()
    debugged.step("over")
    assert debugged.step("over") == "abcde"


def test_in_parallel_the_next_call_of_any_branch_ends_a_step_into() -> None:
    debugged = Debugged(par("all", seq(act("a"), act("b")), seq(act("c"), act("d"))))
    debugged.gate.step("into", ())
    assert debugged.tick() == "" and len(debugged.gate.waiting) == 2
    assert debugged.step("over") == "ac" and len(debugged.gate.waiting) == 2
    debugged.gate.open()
    assert debugged.tick() == "acbd"


def test_breakpoints_hold_a_call_back_by_skill_and_by_line_each_time() -> None:
    line = act("b")
    body = tree.Repeat(count=2, child=seq(act("a"), line, call("Either", name="c")), source=here())
    places = (AtSkill("Either"), AtLine(line.source.path, line.source.line), AtSkill("Missing"))
    debugged = Debugged(body, breakpoints=places)
    for started, reason in (("a", "stage.skill:"), ("ab", "Either"), ("abca", "stage.skill:"), ("abcab", "Either")):
        assert debugged.tick() == started
        assert debugged.gate.reason is not None and reason in debugged.gate.reason
        debugged.gate.open()
    assert debugged.tick() == "abcabc" and debugged.run.status is Status.SUCCESS


@pytest.mark.parametrize(
    ("outer", "inner", "started"),
    [
        ("anywhere", "anywhere", "abc"),
        ("anywhere", "between steps", "abc"),
        ("anywhere", "never", "abcd"),
        ("between steps", "anywhere", "abcd"),
        ("between steps", "between steps", "abcd"),
        ("never", "anywhere", "abcde"),
    ],
)
def test_a_pause_waits_for_the_next_point_where_all_skills_allow_it(outer: str, inner: str, started: str) -> None:
    body, library = nested(outer=PausePolicy(outer), inner=PausePolicy(inner))  # type: ignore[arg-type]
    debugged = Debugged(body, library)
    while "start c" not in debugged.stage.said("start"):
        debugged.run.tick()
        debugged.stage.now += PERIOD_S
    debugged.gate.close("requested")
    assert debugged.tick() == started
    assert bool(debugged.gate.waiting) == (started != "abc" or inner == "between steps")


def test_the_hindrance_is_the_outermost_skill_that_must_not_be_paused() -> None:
    body, library = nested(outer=PausePolicy("between steps"), inner=PausePolicy("never"))
    debugged = Debugged(body, library)
    while "start c" not in debugged.stage.said("start"):
        debugged.run.tick()
    hindrance = debugged.gate.find_hindrance(debugged.run.active_calls)
    assert hindrance is not None and hindrance.skill_name == "Outer"


def test_a_waiting_call_can_be_halted_and_starts_no_more() -> None:
    debugged = Debugged(act("a"))
    debugged.gate.close("requested")
    debugged.tick()
    debugged.run.halt("enough")
    debugged.gate.open()
    assert debugged.run.tick() is Status.HALTED and debugged.stage.said() == []


@pytest.mark.parametrize(
    ("outer", "inner", "shortest"), [(0.5, 7.0, 0.5), (10.0, None, 10.0), (10.0, KEEP_S, KEEP_S), (None, None, KEEP_S)]
)
def test_the_shortest_stated_time_to_keep_the_force_counts(
    outer: float | None, inner: float | None, shortest: float
) -> None:
    body, library = nested(outer=PausePolicy("anywhere", outer), inner=PausePolicy("anywhere", inner))
    debugged = Debugged(body, library)
    debugged.run.tick()
    assert keep_s(debugged.run.active_calls) == KEEP_S
    while "start c" not in debugged.stage.said("start"):
        debugged.run.tick()
    assert keep_s(debugged.run.active_calls) == shortest
