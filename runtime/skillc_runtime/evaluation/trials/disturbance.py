"""Disturbs trials: the work object is missing, an obstacle is in the way, or a person pushes the arm."""

from __future__ import annotations

from typing import assert_never

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.rng import rng_for
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.backends.simulation.variation import Variation, add_obstacles, draw_variation, make_all_absent
from skillc_runtime.evaluation.trials.trial import Disturbance
from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.primitive import Activity
from skillc_runtime.recording.events import Event, ImplementationChosen

PUSH_N, PUSH_S = 30.0, 0.5
"""The force and the duration of a person's push."""

PUSH_AFTER_S = (1.0, 8.0)
"""The range of the delay of the push after the start of the work, in s."""

PUSHED_ACTIVITIES: tuple[Activity, ...] = ("follow-path", "search")
"""The activities during which a person pushes."""


def draw_disturbed_variation(disturbance: Disturbance, scene: SceneSpec, seed: int) -> Variation:
    """Draw how reality differs from the world model, with the disturbance applied."""
    drawn = draw_variation(scene, seed)
    match disturbance:
        case "none" | "push":
            return drawn
        case "missing":
            return make_all_absent(drawn)
        case "obstacle":
            return add_obstacles(drawn, scene)
        case _:
            assert_never(disturbance)


class PushDisturbance:
    """Pushes a hand once, in a random direction, while its arm works along a path or searches.

    It is a listener, which learns when that begins; call `update` after every tick. `pushed` if it has pushed.
    """

    def __init__(self, cell: SimulatedCell) -> None:
        self._cell = cell
        self._arms = {arm.individual: arm for arm in cell.scene.arms}
        self._pushes: dict[str, tuple[float, Array]] = {}
        self.pushed = False

    def __call__(self, event: Event) -> None:
        if not (isinstance(event, ImplementationChosen) and event.activity in PUSHED_ACTIVITIES):
            return
        for arm in (self._arms[each] for each in event.individuals if each in self._arms):
            self._pushes.setdefault(_hand_body(arm, self._cell), self._draw_push(arm, event.time))

    def update(self) -> None:
        """Apply or remove the force of the push, by the time of the cell."""
        for hand, (begins, force) in self._pushes.items():
            pushes = begins <= self._cell.now < begins + PUSH_S
            self._cell.data.body(hand).xfrc_applied[:3] = force if pushes else 0.0
            self.pushed |= pushes

    def _draw_push(self, arm: ArmSpec, now: float) -> tuple[float, Array]:
        rng = rng_for(arm.individual, self._cell.variation.seed, 3)
        direction = rng.standard_normal(3)
        return now + float(rng.uniform(*PUSH_AFTER_S)), PUSH_N * direction / float((direction @ direction) ** 0.5)


def _hand_body(arm: ArmSpec, cell: SimulatedCell) -> str:
    assert arm.gripper is not None, "what works along a path holds a tool"
    return part_name(cell.scene.names[arm.gripper.individual], "palm")
