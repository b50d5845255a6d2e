"""Makes the simulated cell of a trial; the only place of the evaluation that knows which simulation there is."""

from __future__ import annotations

from functools import partial
from typing import assert_never

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.variation import Variation, add_obstacles, draw_variation, make_all_absent
from skillc_runtime.evaluation.trials.trial import Disturbance
from skillc_runtime.world.state.model import WorldModel


def make_trial_cell(world: WorldModel, seed: int, disturbance: Disturbance) -> SimulatedCell:
    """Build the cell of a trial; SheetError or FrameError if the scene cannot be simulated."""
    return SimulatedCell(world, seed, reality=partial(draw_disturbed_variation, disturbance))


def draw_disturbed_variation(disturbance: Disturbance, scene: SceneSpec, seed: int) -> Variation:
    """Draw how reality differs from the world model, with the disturbance applied."""
    drawn = draw_variation(scene, seed)
    match disturbance:
        case "none" | "push" | "take":
            return drawn
        case "missing":
            return make_all_absent(drawn)
        case "obstacle":
            return add_obstacles(drawn, scene)
        case _:
            assert_never(disturbance)
