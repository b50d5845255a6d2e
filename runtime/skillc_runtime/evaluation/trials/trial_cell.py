"""Makes the simulated cell of a trial; the only place of the evaluation that knows which simulation there is."""

from __future__ import annotations

from functools import partial
from typing import assert_never

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.variation.variation import (
    Variation,
    add_obstacles,
    draw_variation,
    exact_variation,
    make_all_absent,
)
from skillc_runtime.evaluation.trials.trial import TrialDisturbance
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState


def make_trial_cell(world: WorldModel, seed: int, disturbance: TrialDisturbance) -> SimulatedCell:
    """Build the cell of a trial; SheetError or FrameError if the scene cannot be simulated."""
    return SimulatedCell(world, seed, reality=partial(draw_disturbed_variation, disturbance))


def draw_disturbed_variation(disturbance: TrialDisturbance, scene: SceneSpec, seed: int) -> Variation:
    """Draw how reality differs from the world model, with the disturbance applied."""
    return _disturb(draw_variation(scene, seed), disturbance, scene)


def is_without_effect(disturbance: TrialDisturbance, state: WorldState) -> bool:
    """Whether a scene has nothing that can be missing, or nothing on which an obstacle can be.

    SheetError or FrameError if the scene cannot be simulated.
    """
    if disturbance not in ("missing", "obstacle"):
        return False
    scene = read_scene_spec(state)
    exact = exact_variation(scene)
    return _disturb(exact, disturbance, scene) == exact


def _disturb(drawn: Variation, disturbance: TrialDisturbance, scene: SceneSpec) -> Variation:
    match disturbance:
        case "none" | "push" | "take":
            return drawn
        case "missing":
            return make_all_absent(drawn)
        case "obstacle":
            return add_obstacles(drawn, scene)
        case _:
            assert_never(disturbance)
