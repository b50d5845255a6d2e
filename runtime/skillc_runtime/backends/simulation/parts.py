"""What takes part in the steps of any cell: a driver with its arm, those who listen, and the tool in a hand."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from skillc_runtime.backends.simulation.arms.arm import ModelledArm
from skillc_runtime.backends.simulation.arms.sensing import NOT_READY
from skillc_runtime.backends.simulation.hands.gripper import ModelledGripper
from skillc_runtime.backends.simulation.truth.observer import Carrier, ToolObserver
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.motion.numerics.program import IDLE, Part, Rows, join, row_of


class ArmPart:
    """A control period of one arm: its driver measures, computes and commands, unless the arm was lost."""

    def __init__(self, arm: ModelledArm, driver: CompliantArmDriver, is_lost: Callable[[], bool]) -> None:
        self._arm, self._driver, self._is_lost = arm, driver, is_lost
        self._found: tuple[tuple[object, ...], Rows | None] = (), None

    @property
    def rows(self) -> Rows | None:
        """The functions that `CompliantArmDriver.step` calls while nothing happens."""
        if self._is_lost():
            return IDLE
        driver, arm = self._driver, self._arm
        functions = driver.functions
        if functions is None:
            self._found = (), None
            return None
        state = (*functions, arm.braked, arm.is_faulty, arm.interface)
        if state != self._found[0]:
            begin, control = map(row_of, functions)
            self._found = state, join(begin, arm.measuring, control, arm.taking(driver.values))
        return self._found[1]

    def step(self, now: float) -> bool:
        """Run the period."""
        before = self._found[1]
        if not self._is_lost():
            self._driver.step(now)
        return self.rows is not before

    def act(self, events: int, now: float) -> bool:
        """Do what is left of the period; what it does to other parts follows from what the arm follows now."""
        if events == NOT_READY:
            return self.step(now)
        before = self._found[1]
        self._driver.act(events)
        return self.rows is not before


class Listening:
    """Others that take part in a cell for a while: who records it, or people in it."""

    def __init__(self, find: Callable[[], Sequence[Part]]) -> None:
        self._find = find

    @property
    def rows(self) -> Rows | None:
        """Their functions; if there are several, Python calls them."""
        parts = self._find()
        return IDLE if not parts else parts[0].rows if len(parts) == 1 else None

    def step(self, now: float) -> bool:
        """Let all take part."""
        for part in tuple(self._find()):
            part.step(now)
        return True

    def act(self, events: int, now: float) -> bool:
        """Do what the only one asks for, if it still takes part."""
        return any(part.act(events, now) for part in tuple(self._find()))


class HeldTool:
    """The tool that a hand carries, if it is observed; `observers` are by tool."""

    def __init__(self, hand: ModelledGripper, carrier: Carrier, observers: Mapping[str, ToolObserver]) -> None:
        self._hand, self._carrier, self._observers = hand, carrier, observers

    @property
    def rows(self) -> Rows | None:
        """The functions that observe it."""
        observer = self._observer
        return IDLE if observer is None else observer.rows(self._carrier)

    def step(self, now: float) -> bool:
        """Observe it."""
        if (observer := self._observer) is not None:
            observer.sample(now, self._carrier)
        return True

    def act(self, events: int, now: float) -> bool:
        """Make room for more."""
        observer = self._observer
        return observer is not None and observer.act(now, self._carrier)

    @property
    def _observer(self) -> ToolObserver | None:
        return self._observers.get(self._hand.carries or "")
