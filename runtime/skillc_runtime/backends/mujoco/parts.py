"""What takes part in the steps of a cell with physics: the physics itself, and the friction of a grasp."""

from __future__ import annotations

from skillc_runtime.backends.mujoco.gripper import SimulatedGripper
from skillc_runtime.backends.mujoco.mirror import Half
from skillc_runtime.backends.mujoco.physics import Physics
from skillc_runtime.motion.numerics.program import Rows


class HalfStep:
    """A half of a step of the physics."""

    def __init__(self, physics: Physics, half: Half) -> None:
        self._physics, self._half = physics, half

    @property
    def rows(self) -> Rows | None:
        """The function of MuJoCo, and what shows its results."""
        return self._physics.find_rows(self._half)

    def step(self, now: float) -> bool:
        """Run it."""
        match self._half:
            case "mj_step1":
                self._physics.compute_places()
            case "mj_step2":
                self._physics.move()
        return True

    def act(self, events: int, now: float) -> bool:
        """Do nothing: it tells of nothing."""
        return False


class DivergenceWatch:
    """Ends the cell if the physics that is stepped diverges."""

    def __init__(self, physics: Physics) -> None:
        self._physics = physics

    @property
    def rows(self) -> Rows | None:
        """The function that looks for warnings."""
        return self._physics.monitor.rows

    def step(self, now: float) -> bool:
        """Raise SimulationDiverged if there are any."""
        return self._physics.monitor.step(now)

    def act(self, events: int, now: float) -> bool:
        """Raise SimulationDiverged."""
        return self._physics.monitor.act(events, now)


class SlipWatch:
    """Lets what a hand carries slip once more pulls at it than friction bears."""

    def __init__(self, hand: SimulatedGripper) -> None:
        self._hand = hand

    @property
    def rows(self) -> Rows | None:
        """The function that tells when that has to be looked at."""
        return self._hand.slip_rows

    def step(self, now: float) -> bool:
        """Look at it if it is time; tell whether it slips."""
        if self._hand.carries is not None and self._hand.slips(now):
            self._hand.lose()
        return self._hand.carries is None

    def act(self, events: int, now: float) -> bool:
        """Look at it."""
        return self.step(now)
