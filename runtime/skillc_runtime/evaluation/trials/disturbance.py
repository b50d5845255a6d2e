"""What may happen in a trial besides: what is worked on is not there, something is in the way, a person pushes."""

from __future__ import annotations

from typing import assert_never

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.mujoco.names import part_name
from skillc_runtime.backends.mujoco.rng import rng_for
from skillc_runtime.backends.mujoco.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.backends.mujoco.variation import Variation, add_obstacles, draw_variation, make_all_absent
from skillc_runtime.evaluation.trials.trial import Disturbance
from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.primitive import Activity
from skillc_runtime.recording.events import Event, ImplementationChosen

PUSH_N, PUSH_S = 30.0, 0.5
"""How hard and how long a person pushes."""

PUSH_AFTER_S = (1.0, 8.0)
"""When, after the work has begun."""

WORKING: tuple[Activity, ...] = ("follow-path", "search")
"""What is done while a person pushes."""


def reality(disturbance: Disturbance, scene: SceneSpec, seed: int) -> Variation:
    """Draw how reality differs from the facts, and then disturb it."""
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
    """Pushes a hand once, in any direction, while its arm works along a path or searches.

    A listener that learns when that begins; `watch` is to be called after every tick. `pushed`: it came to that.
    """

    def __init__(self, cell: SimulatedCell) -> None:
        self._cell = cell
        self._arms = {arm.individual: arm for arm in cell.scene.arms}
        self._pushes: dict[str, tuple[float, Array]] = {}
        self.pushed = False

    def __call__(self, event: Event) -> None:
        if not (isinstance(event, ImplementationChosen) and event.activity in WORKING):
            return
        for arm in (self._arms[each] for each in event.individuals if each in self._arms):
            self._pushes.setdefault(_hand(arm, self._cell), self._decided(arm, event.time))

    def watch(self) -> None:
        """Push, or let go."""
        for hand, (begins, force) in self._pushes.items():
            pushes = begins <= self._cell.now < begins + PUSH_S
            self._cell.data.body(hand).xfrc_applied[:3] = force if pushes else 0.0
            self.pushed |= pushes

    def _decided(self, arm: ArmSpec, now: float) -> tuple[float, Array]:
        rng = rng_for(arm.individual, self._cell.variation.seed, 3)
        direction = rng.standard_normal(3)
        return now + float(rng.uniform(*PUSH_AFTER_S)), PUSH_N * direction / float((direction @ direction) ** 0.5)


def _hand(arm: ArmSpec, cell: SimulatedCell) -> str:
    assert arm.gripper is not None, "what works along a path holds a tool"
    return part_name(cell.scene.names[arm.gripper.individual], "palm")
