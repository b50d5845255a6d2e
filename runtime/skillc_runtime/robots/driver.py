"""The heart of one arm: tells it, once a control period, how to do what it shall, and stops it where it must not."""

from __future__ import annotations

import numpy as np

from skillc_runtime.controllers.controller import ControlError
from skillc_runtime.robots.arm import ArmState, Command
from skillc_runtime.robots.arm_task import ArmTask
from skillc_runtime.robots.guard import Guard
from skillc_runtime.robots.measured import Observer
from skillc_runtime.robots.setup import Setup

LONGEST_GAP_S = 0.02
"""When a control period comes later than this after the one before, or earlier, motions wait for the time lost."""


class ArmDriver(ArmTask):
    """One arm, stepped every `period` s.

    `fault` says why the driver stopped by itself, until somebody has dealt with it; `broken` why the arm once could
    not be controlled.
    """

    def __init__(self, setup: Setup) -> None:
        """Hold the arm where it is; what breaks its safety limits is told in `fault`."""
        super().__init__(setup)
        self.fault: str | None = None
        self.broken: str | None = None
        self._guard = Guard(setup.arm, self._state, setup.safety)
        self._observers: tuple[Observer, ...] = ()
        self._seen = self._lost = 0.0

    def step(self, now: float) -> None:
        """Do one control period at `now` s. ControlError when a measurement or a command is not a number."""
        gap, self._seen = now - self._seen, now
        if not 0 <= gap <= max(LONGEST_GAP_S, 2 * self.period):
            self._lost += gap - self.period
        self._now = now - self._lost
        state = self._arm.state()
        try:
            self._guard.check(state)
            self._take_in(state)
            if (breach := self._guard.breach(state, self.period)) is not None:
                self.hold_still(breach)
            self._guard.command(self._decide(state), self.period)
        except ControlError as fault:
            self.broken = str(fault)
            raise
        for observer in self._observers:
            observer(state)

    def _decide(self, state: ArmState) -> Command:
        self._tool.yielding.step(self.period)
        try:
            if self._joints is not None:
                return self._laws.joints.command(state, self._joints.sample(self._now), self.period)
            return self._tool.command(state, self._now, self.period)
        except ControlError as fault:
            self._joints = self._joint_guide(self._laws.joints_now(state), np.zeros_like(state.q))
            self.broken = str(fault)
            self.abort(self.broken)
            return self._guard.holding()

    def watch(self, observer: Observer) -> None:
        """Call the observer after every control period."""
        self._observers = (*self._observers, observer)

    def unwatch(self, observer: Observer) -> None:
        """Call the observer no more."""
        self._observers = tuple(each for each in self._observers if each != observer)

    def abort(self, reason: str) -> None:
        """Stop moving, circling and pushing; whoever moves the arm finds the reason in `fault`."""
        self.fault = reason
        self.stop()
        self._tool.let_go(self._now)

    def hold_still(self, reason: str) -> None:
        """Hold the arm where it is, at once, and push no more; whoever moves it finds the reason in `fault`."""
        self.fault, q = reason, self._laws.joints_held(self._state)
        if self._joints is None:
            self._tool.hold(self._state, q, self._now)
        else:
            self._joints = self._joint_guide(q, np.zeros_like(q))

    def secure(self) -> bool:
        """Come to rest, push no more and hold stiff, whatever skills left; tell whether they left the arm yielding.

        Observers that skills left are called no more.
        """
        self._observers = ()
        self.stop()
        self._tool.let_go(self._now)
        yielding, left = self._tool.yielding, not self._tool.yielding.stiff
        while yielding.released:
            self.restore()
        if not yielding.stiff:
            self.restore_rotation()
        return left
