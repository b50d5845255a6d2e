"""Pauses a task run on request, at breakpoints and after steps: until its devices are still, and tools taken off."""

from __future__ import annotations

from typing import Literal, TypeAlias, assert_never

from skillc_runtime.devices.backend import Clock
from skillc_runtime.execution.attempt import SETTLE_S
from skillc_runtime.execution.tree.context import EPSILON_S
from skillc_runtime.execution.tree.gate import Gate, keep_s
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.recording.commands import PauseRun, Resume, StepInto, StepOut, StepOver

PauseCommand: TypeAlias = PauseRun | Resume | StepInto | StepOver | StepOut
PauseState: TypeAlias = Literal["running", "pausing", "paused"]


class PauseControl:
    """Pauses a tree where its skills allow it, as soon as the gate has a reason.

    `state` is how far the pause is, and `reason` why, or for what it waits.
    """

    def __init__(self, gate: Gate, clock: Clock) -> None:
        self._gate, self._clock = gate, clock
        self._since = self._keep_s = 0.0
        self.state: PauseState = "running"
        self.reason = ""

    def obey(self, command: PauseCommand, tree: TreeRun) -> None:
        """Begin to pause, or let the tree go on, to the end of a step if one is requested."""
        match command:
            case PauseRun(reason=reason):
                self._gate.close(reason)
                self.state, self.reason = "pausing", reason
                if tree.paused:  # its tools approach again
                    tree.pause()
                return
            case Resume():
                self._gate.open()
            case StepInto():
                self._gate.step("into", tree.active_calls)
            case StepOver():
                self._gate.step("over", tree.active_calls)
            case StepOut():
                self._gate.step("out", tree.active_calls)
            case _:
                assert_never(command)
        self.state, self.reason = "running", ""
        tree.resume()

    def follow(self, tree: TreeRun) -> None:
        """Go on with a pause, after a tick of the tree."""
        if self._gate.reason is None:
            return
        if tree.paused:
            self._follow_paused(tree)
        else:
            self._pause_if_allowed(tree, self._gate.reason)

    def _pause_if_allowed(self, tree: TreeRun, reason: str) -> None:
        active = tree.active_calls
        hindrance = self._gate.find_hindrance(active)
        self.state, self.reason = "pausing", reason
        if hindrance is not None:
            self.reason = f"{reason}; {hindrance.skill_name} must be finished or at its next step first"
            return
        self._since, self._keep_s = self._clock.now, keep_s(active)
        tree.pause()

    def _follow_paused(self, tree: TreeRun) -> None:
        passed = self._clock.now - self._since
        if self.state == "pausing" and (tree.is_still or passed > SETTLE_S):
            self.state = "paused"
        if passed >= self._keep_s - EPSILON_S and not tree.withdrawn:
            tree.withdraw()
