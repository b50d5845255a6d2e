"""Disturbs trials: a person pushes an arm, or takes what a hand holds out of it."""

from __future__ import annotations

from math import cos, pi, sin
from typing import Protocol

from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.cell import Cell
from skillc_runtime.devices.disturbances import Disturber, TakeThing
from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.primitive import Activity
from skillc_runtime.recording.events import Event, ImplementationChosen
from skillc_runtime.world.state.terms import ARM_DEVICE, HAS_GRIPPER

PUSH_N, PUSH_S = 30.0, 0.5
"""The force and the duration of a person's push."""

PUSH_AFTER_S = (1.0, 8.0)
"""The range of the delay of the push after the start of the work, in s."""

PUSHED_ACTIVITIES: tuple[Activity, ...] = ("follow-path", "search")
"""The activities during which a person pushes."""


TAKE_AFTER_S = (0.2, 1.5)
"""The range of the time for which a hand has held something when a person takes it, in s."""

TAKE_M = 0.3
"""How far to the side a person puts what they take."""


class TrialCell(Backend, Cell, Protocol):
    """A simulated cell whose truth is known, and in which a person can push an arm."""

    @property
    def ground_truth(self) -> GroundTruth:
        """The true state of the cell."""
        ...

    @property
    def disturber(self) -> Disturber:
        """Lets things happen to the cell that no skill does."""
        ...

    def push_hand(self, arm: str, force_n: Array) -> None:
        """Push the hand of an arm with a force (3,) in N in the world from now on; 0 ends it."""
        ...


class PushDisturbance:
    """Pushes a hand once, in a random direction, while its arm works along a path or searches.

    It is a listener, which learns when that begins; call `update` after every tick. `pushed` if it has pushed.
    """

    def __init__(self, simulation: TrialCell) -> None:
        self._simulation = simulation
        self._arms = simulation.cell.world.snapshot().instances(ARM_DEVICE)
        self._pushes: dict[str, tuple[float, Array]] = {}
        self.pushed = False

    def __call__(self, event: Event) -> None:
        if not (isinstance(event, ImplementationChosen) and event.activity in PUSHED_ACTIVITIES):
            return
        for arm in (each for each in event.individuals if each in self._arms):
            self._pushes.setdefault(arm, self._draw_push(arm, event.time))

    def update(self) -> None:
        """Apply or remove the force of the push, by the time of the cell."""
        now = self._simulation.clock.now
        for arm, (begins, force) in self._pushes.items():
            pushes = begins <= now < begins + PUSH_S
            self._simulation.push_hand(arm, force if pushes else 0.0 * force)
            self.pushed |= pushes

    def _draw_push(self, arm: str, now: float) -> tuple[float, Array]:
        rng = rng_for(arm, self._simulation.ground_truth.seed, 3)
        direction = rng.standard_normal(3)
        return now + float(rng.uniform(*PUSH_AFTER_S)), PUSH_N * direction / float((direction @ direction) ** 0.5)


class TakeDisturbance:
    """Takes the first thing that a hand holds out of it, once, and puts it aside in a random direction.

    Call `update` after every tick. `taken` if it has.
    """

    def __init__(self, simulation: TrialCell) -> None:
        self._simulation = simulation
        self._hands = sorted({hand for _, hand in simulation.cell.world.snapshot().pairs(HAS_GRIPPER)})
        self._rng = rng_for("", simulation.ground_truth.seed, 7)
        self._after_s, self._held_since = float(self._rng.uniform(*TAKE_AFTER_S)), dict[str, float]()
        self.taken = False

    def update(self) -> None:
        """Take what has been held for long enough."""
        for hand in () if self.taken else self._hands:
            thing, now = self._simulation.ground_truth.carried_by(hand), self._simulation.clock.now
            if thing is None:
                self._held_since.pop(hand, None)
            elif now - self._held_since.setdefault(hand, now) >= self._after_s:
                turn = float(self._rng.uniform(-pi, pi))
                self._simulation.disturber.disturb(TakeThing(thing, (TAKE_M * cos(turn), TAKE_M * sin(turn), 0.0)))
                self.taken = True
                return
