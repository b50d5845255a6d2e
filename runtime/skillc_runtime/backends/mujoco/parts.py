"""What takes part in the steps of a cell with physics: the physics itself, and the friction of a grasp."""

from __future__ import annotations

from skillc_runtime.backends.mujoco.gripper import SimulatedGripper
from skillc_runtime.backends.mujoco.mirror import Half
from skillc_runtime.backends.mujoco.physics import Physics
from skillc_runtime.motion.numerics.program import IDLE, Rows, row_of


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
