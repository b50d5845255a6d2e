"""What takes part in the steps of a cell with physics: the physics itself, and the friction of a grasp."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from skillc_runtime.backends.mujoco.gripper import SimulatedGripper
from skillc_runtime.backends.mujoco.mirror import Half
from skillc_runtime.backends.mujoco.physics import Physics
from skillc_runtime.backends.simulation.bases.base import SimulatedBase
from skillc_runtime.backends.simulation.cargo import Cargo
from skillc_runtime.motion.numerics.program import IDLE, Rows, join, row_of


class HalfStep:
    """A half of a step of the physics, which ends the cell if it diverges."""

    def __init__(self, physics: Physics, half: Half) -> None:
        self._physics, self._half = physics, half

    @property
    def rows(self) -> Rows | None:
        """The function of MuJoCo, what shows its results, and what looks for warnings."""
        return self._physics.find_rows(self._half)

    def step(self, now: float) -> bool:
        """Run it; raise SimulationDiverged if there are warnings."""
        match self._half:
            case "mj_step1":
                self._physics.compute_places()
            case "mj_step2":
                self._physics.move()
        self._physics.monitor.step(now)
        return True

    def act(self, events: int, now: float) -> bool:
        """Raise SimulationDiverged."""
        return self._physics.monitor.act(events, now)


class Drive:
    """Moves bases with their cargo; machine code does while one of them drives that carries nothing.

    `in_python` makes a step, given its beginning in s.
    """

    def __init__(
        self,
        bases: Mapping[str, SimulatedBase],
        cargo: Mapping[str, Cargo],
        physics: Physics,
        in_python: Callable[[float], None],
    ) -> None:
        self._each = [(base, cargo[robot]) for robot, base in bases.items()]
        self._physics, self._in_python = physics, in_python
        self._found: tuple[Rows | None, Rows | None, Rows | None] = None, None, None

    @property
    def rows(self) -> Rows | None:
        """Nothing while all rests; None where Python moves cargo."""
        if not (busy := self._find_busy()):
            return IDLE
        if (base := self._find_alone(busy)) is None:
            return None
        drive, taking = row_of(base.drive), self._physics.taking
        if drive is not self._found[0] or taking is not self._found[1]:
            self._found = drive, taking, join(drive, taking)
        return self._found[2]

    def step(self, now: float) -> bool:
        """Make a step."""
        if not (busy := self._find_busy()):
            return False
        base = self._find_alone(busy)
        if base is None or base.drive(now) != 0:
            return self.act(1, now)
        self._physics.take_changes()
        return False

    def act(self, events: int, now: float) -> bool:
        """Make a step in which the bumper is looked at, cargo is moved, or a base comes to rest."""
        before = self.rows
        self._in_python(now)
        return self.rows is not before

    def _find_busy(self) -> list[tuple[SimulatedBase, Cargo]]:
        return [each for each in self._each if not (each[0].at_rest and each[1].at_rest)]

    def _find_alone(self, busy: list[tuple[SimulatedBase, Cargo]]) -> SimulatedBase | None:
        """Return the base that drives if it is the only one, and carries nothing."""
        base, cargo = busy[0]
        return base if len(busy) == 1 and not base.at_rest and cargo.is_empty else None


class SlipWatch:
    """Lets what a hand carries slip once more pulls at it than friction bears."""

    def __init__(self, hand: SimulatedGripper) -> None:
        self._hand = hand

    @property
    def rows(self) -> Rows | None:
        """The function that looks at the load."""
        watch = self._hand.load_watch
        return IDLE if watch is None else row_of(watch)

    def step(self, now: float) -> bool:
        """Look at the load."""
        watch = self._hand.load_watch
        events = 0 if watch is None else watch(now)
        return events != 0 and self.act(events, now)

    def act(self, events: int, now: float) -> bool:
        """Let it slip if that is what was found."""
        slips = self._hand.loses(events, now)
        if slips:
            self._hand.lose()
        return slips
