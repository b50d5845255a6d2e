"""Follows a request to pause until the devices are still, and takes tools off after a while."""

from __future__ import annotations

from typing import Literal, TypeAlias

from skillc_runtime.devices.backend import Clock
from skillc_runtime.execution.attempt import SETTLE_S
from skillc_runtime.execution.tree.gate import Gate, keep_s
from skillc_runtime.execution.tree.run import TreeRun

PauseState: TypeAlias = Literal["running", "pausing", "paused"]


class PauseFollower:
    """Pauses a tree where its skills allow it, as soon as the gate has a reason.

    `state` is how far the pause is, and `reason` why, or for what it waits.
    """

    def __init__(self, gate: Gate, clock: Clock) -> None:
        self._gate, self._clock = gate, clock
        self._since = self._keep_s = 0.0
        self.state: PauseState = "running"
        self.reason = ""

    def begin(self, tree: TreeRun) -> None:
        """Begin to pause, as the gate says; if tools approach again after a pause, withdraw them."""
        self.state, self.reason = "pausing", self._gate.reason or ""
        if tree.paused:
            tree.pause()

    def follow(self, tree: TreeRun) -> None:
        """Go on with a pause, after a tick of the tree."""
        if self._gate.reason is None:
            return
        if tree.paused:
            self._follow_paused(tree)
        else:
            self._pause_if_allowed(tree, self._gate.reason)

    def resume(self, tree: TreeRun) -> None:
        """Let the tree go on; the gate is open, or waits for the end of a step."""
        self.state, self.reason = "running", ""
        tree.resume()

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
        if passed >= self._keep_s and not tree.withdrawn:
            tree.withdraw()
