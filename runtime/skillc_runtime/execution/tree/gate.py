"""Decides where a run pauses: at a breakpoint, after a step, or at the next point where its skills may be paused."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Literal, Protocol, TypeAlias, assert_never

import msgspec

from skillc_dsl.position import Position
from skillc_model.skills import KEEP_S, PausePolicy

StepKind: TypeAlias = Literal["into", "over", "out"]
MOST_DIGITS = 9
"""The most digits of a line in a breakpoint."""


class AtSkill(msgspec.Struct, frozen=True):
    """A breakpoint at each call of a skill."""

    skill: str


class AtLine(msgspec.Struct, frozen=True):
    """A breakpoint at each call in a line of a file."""

    path: str
    line: int


Breakpoint: TypeAlias = AtSkill | AtLine


class GatedCall(Protocol):
    """A call in a tree, as the gate sees it."""

    @property
    def skill_name(self) -> str:
        """The name of the skill."""
        ...

    @property
    def source(self) -> Position:
        """The place of the call."""
        ...

    @property
    def pause_policy(self) -> PausePolicy:
        """Where the skill may be paused."""
        ...

    @property
    def is_queued(self) -> bool:
        """Whether it waits for what others use, and has not started."""
        ...

    def enclosing_calls(self) -> Iterator[GatedCall]:
        """Yield the calls around it, the innermost first."""
        ...


class Gate:
    """Holds calls back before they start, so that a run can pause there; shared by all attempts of a task run.

    `reason` says why the run is to pause; None if it is not. The calls in `waiting` do not start before `open`.
    `confirms_steps`: the run pauses before each step, a call that no other call is around.
    """

    def __init__(self, breakpoints: Iterable[Breakpoint] = (), confirms_steps: bool = False) -> None:
        self.breakpoints, self._confirms_steps = frozenset(breakpoints), confirms_steps
        self.reason: str | None = None
        self.waiting: list[GatedCall] = []
        self._step: Callable[[GatedCall], bool] | None = None

    @property
    def stepping(self) -> bool:
        """Whether the run is to pause after a step."""
        return self._step is not None

    def close(self, reason: str) -> None:
        """Pause at the next point where all active skills may be paused."""
        self.reason = self.reason or reason

    def open(self) -> None:
        """Let all waiting calls start, and forget that the run is to pause."""
        self.reason, self._step = None, None
        self.waiting = []

    def forget_waiting(self) -> None:
        """Forget the calls of a tree that has ended; if the run is to pause, it still is."""
        self.waiting = []

    def step(self, kind: StepKind, active: Iterable[GatedCall]) -> None:
        """Open, and hold back the call after a step; `active` are the innermost active calls."""
        around = tuple(self._calls_to_finish(kind, tuple(active)))
        self.open()
        self._step = lambda call: not any(each is one for each in call.enclosing_calls() for one in around)

    def stops(self, call: GatedCall) -> bool:
        """Tell whether a call must wait before it starts; it is in `waiting` then."""
        if self.reason is None:
            self.reason = self._reason_to_stop(call)
        if self.reason is None or not is_pause_point(call):
            return False
        self.waiting.append(call)
        return True

    def holds_back(self, call: GatedCall) -> bool:
        """Tell whether a call still has to wait."""
        return any(each is call for each in self.waiting)

    def find_hindrance(self, active: Iterable[GatedCall]) -> GatedCall | None:
        """Return the skill that must not be paused now, outermost first, given the innermost active calls."""
        for call in active:
            around = (call, *call.enclosing_calls())
            if not self.holds_back(call) and not (call.is_queued and is_pause_point(call)):
                hindrance = next((each for each in reversed(around) if each.pause_policy.where != "anywhere"), None)
                if hindrance is not None:
                    return hindrance
        return None

    def _reason_to_stop(self, call: GatedCall) -> str | None:
        if self._step is not None and self._step(call):
            return f"step: {call.skill_name} is next"
        if self._confirms_steps and next(call.enclosing_calls(), None) is None:
            return f"{call.skill_name} is to be confirmed"
        met = next((each for each in self.breakpoints if _is_at(each, call)), None)
        return None if met is None else f"breakpoint at {format_breakpoint(met)}"

    def _calls_to_finish(self, kind: StepKind, active: tuple[GatedCall, ...]) -> Iterator[GatedCall]:
        """Yield the calls inside which the step does not end."""
        match kind:
            case "into":
                return
            case "over":
                yield from active
            case "out":
                yield from (next(call.enclosing_calls(), call) for call in active)
            case _:
                assert_never(kind)


def is_pause_point(call: GatedCall) -> bool:
    """Tell whether the skills around a call may be paused before it starts."""
    for number, each in enumerate(call.enclosing_calls()):
        match each.pause_policy.where:
            case "never":
                return False
            case "between steps" if number > 0:
                return False
            case _:
                pass
    return True


def keep_s(active: Iterable[GatedCall]) -> float:
    """Return for how long a paused tool may go on pressing, in s: the shortest time that an active skill states."""
    policies = [each.pause_policy for call in active for each in (call, *call.enclosing_calls())]
    return min((policy.keep_s for policy in policies if policy.keep_s is not None), default=KEEP_S)


def format_breakpoints(breakpoints: Iterable[Breakpoint]) -> tuple[str, ...]:
    """Return breakpoints as they are written, sorted."""
    return tuple(sorted(map(format_breakpoint, breakpoints)))


def format_breakpoint(breakpoint_: Breakpoint) -> str:
    """Return a breakpoint as it is written."""
    match breakpoint_:
        case AtSkill(skill):
            return skill
        case AtLine(path, line):
            return f"{path}:{line}"
        case _:
            assert_never(breakpoint_)


def read_breakpoint(text: str) -> Breakpoint:
    """Return the breakpoint that `format_breakpoint` has written."""
    path, _, line = text.rpartition(":")
    return AtLine(path, int(line)) if path and line.isdecimal() and len(line) <= MOST_DIGITS else AtSkill(text)


def _is_at(breakpoint_: Breakpoint, call: GatedCall) -> bool:
    match breakpoint_:
        case AtSkill(skill):
            return call.skill_name == skill
        case AtLine(path, line):
            return call.source.line == line and call.source.path == path
        case _:
            assert_never(breakpoint_)
