"""What may happen in a trial besides: what is worked on is not there, something is in the way, a person pushes."""

from __future__ import annotations

from typing import assert_never

from skillc_runtime.motion.pose import Array
from skillc_runtime.report.wiping import PATH_SKILL
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.simulation.facts import ArmFacts, SceneFacts
from skillc_runtime.simulation.names import part
from skillc_runtime.simulation.random_sources import rng_for
from skillc_runtime.simulation.variation import Variation, deserted, draw, with_obstacles
from skillc_runtime.trace.events import Event, ImplementationChosen
from skillc_runtime.trials.trial import Disturbance

PUSH_N, PUSH_S = 30.0, 0.5
"""How hard and how long a person pushes."""

PUSH_AFTER_S = (1.0, 8.0)
"""When, after the work has begun."""

WORKING = (PATH_SKILL, "SinkBelow")
"""The skills in which a person pushes: along a path, and in search of a hole."""


def reality(disturbance: Disturbance, scene: SceneFacts, seed: int) -> Variation:
    """Draw how reality differs from the facts, and then disturb it."""
    drawn = draw(scene, seed)
    match disturbance:
        case "none" | "push":
            return drawn
        case "missing":
            return deserted(drawn)
        case "obstacle":
            return with_obstacles(drawn, scene)
        case _:
            assert_never(disturbance)


class Person:
    """Pushes a hand once, in any direction, while its arm works along a path or searches.

    A listener that learns when that begins; `watch` is to be called after every tick. `pushed`: it came to that.
    """

    def __init__(self, cell: SimulatedCell) -> None:
        self._cell = cell
        self._arms = {cell.facts.names[arm.individual]: arm for arm in cell.facts.arms}
        self._pushes: dict[str, tuple[float, Array]] = {}
        self.pushed = False

    def __call__(self, event: Event) -> None:
        if isinstance(event, ImplementationChosen) and event.skill in WORKING:
            arm = self._arms[event.bindings["arm"]]
            self._pushes.setdefault(_hand(arm, self._cell), self._decided(arm, event.time))

    def watch(self) -> None:
        """Push, or let go."""
        for hand, (begins, force) in self._pushes.items():
            pushes = begins <= self._cell.now < begins + PUSH_S
            self._cell.data.body(hand).xfrc_applied[:3] = force if pushes else 0.0
            self.pushed |= pushes

    def _decided(self, arm: ArmFacts, now: float) -> tuple[float, Array]:
        chance = rng_for(arm.individual, self._cell.variation.seed, 3)
        direction = chance.standard_normal(3)
        return now + float(chance.uniform(*PUSH_AFTER_S)), PUSH_N * direction / float((direction @ direction) ** 0.5)


def _hand(arm: ArmFacts, cell: SimulatedCell) -> str:
    assert arm.gripper is not None, "what works along a path holds a tool"
    return part(cell.facts.names[arm.gripper.individual], "palm")
