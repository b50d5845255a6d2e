"""Cells of the shipped scenes, and what the tests do in them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest

from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.compute_here import compute_here
from skillc_runtime.primitives.grasp import Grasp
from skillc_runtime.primitives.gripper import ParallelGripper, ThreeFingerGripper
from skillc_runtime.primitives.move import MoveJoints, MoveLinear
from skillc_runtime.primitives.primitive import Primitive, Status
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import AddRelation, Change
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import AT
from skillc_runtime.world.state.world_state import WorldState

LAB = "http://example.org/lab#"
ERASER = LAB + "Eraser-1"
SCENES = ("iiwa_table", "ur5e_whiteboard")
HANDS = ("iiwa_table", *(pytest.param(scene, marks=pytest.mark.sim) for scene in ("ur5e_whiteboard", "panda_desk")))
"""Scenes with every gripper there is; the fast tests take one of them."""
ARM = {"iiwa_table": LAB + "Iiwa-1", "ur5e_whiteboard": LAB + "Ur5e-1", "panda_desk": LAB + "Panda-1"}
GRIPPER = {"iiwa_table": LAB + "Robotiq-1", "ur5e_whiteboard": LAB + "Wsg-1", "panda_desk": LAB + "Hand-1"}
PLACE = {"iiwa_table": LAB + "Cell", "ur5e_whiteboard": LAB + "Store", "panda_desk": LAB + "Cell"}
SURFACE = {"iiwa_table": LAB + "Table-1", "ur5e_whiteboard": LAB + "Whiteboard-1"}
FINGERS = {"iiwa_table": ThreeFingerGripper, "ur5e_whiteboard": ParallelGripper, "panda_desk": ParallelGripper}


@cache
def vocabulary() -> Vocabulary:
    return load([Source(path, text) for path, text in catalogue.vocabulary_files()]).value


def at_the_eraser(scene: str, seed: int = 0, changes: Sequence[Change] = ()) -> SimulatedCell:
    """Return a cell whose robot is where the eraser is."""
    moved = [AddRelation(LAB + "Heron-1", AT, LAB + "Store")] if scene == "ur5e_whiteboard" else []
    return SimulatedCell(WorldModel(world(scene).with_changes([*moved, *changes])), seed)


@cache
def world(scene: str) -> WorldState:
    return load_scene(catalogue.scene_path(scene), vocabulary())


def cell(scene: str, seed: int = 0) -> SimulatedCell:
    return SimulatedCell(WorldModel(world(scene)), seed)


def begin(primitive: Primitive) -> None:
    """Start a primitive, and compute here what a tree lets it compute beside its ticks."""
    primitive.start()
    compute_here(primitive)


def run(cell: SimulatedCell, primitive: Primitive, limit_s: float = 30.0) -> None:
    begin(primitive)
    for _ in range(round(limit_s / 0.02)):
        if primitive.tick() is Status.SUCCESS:
            return
        cell.advance(0.02)
    raise AssertionError(f"{type(primitive).__name__} does not end within {limit_s} s")


def move_fingers(cell: SimulatedCell, scene: str, opening: float, force: float = 30.0) -> None:
    run(cell, FINGERS[scene](cell, gripper=GRIPPER[scene], opening=opening, force=force))


def reach_for_eraser(cell: SimulatedCell, scene: str, force: float = 30.0, pace: float = 0.8) -> None:
    """Put the open gripper around the handle and close it."""
    state = cell.world.snapshot()
    move_fingers(cell, scene, 0.065)
    run(cell, MoveJoints(cell, arm=ARM[scene], target=pose(state, ERASER + "-approach"), pace=pace))
    run(cell, MoveLinear(cell, arm=ARM[scene], target=pose(state, ERASER + "-grasp"), speed=0.2))
    move_fingers(cell, scene, 0.0, force)


def grasp(cell: SimulatedCell, scene: str) -> None:
    at = pose(cell.world.snapshot(), ERASER + "-grasp")
    run(
        cell,
        Grasp(cell, arm=ARM[scene], gripper=GRIPPER[scene], object=ERASER, at=at, place=PLACE[scene]),
    )


def lift(cell: SimulatedCell, scene: str, height_m: float = 0.1) -> None:
    """Go straight up."""
    target = cell.arm(ARM[scene]).motion.stopping_pose()
    raised = Pose(target.position + np.array([0.0, 0.0, height_m]), target.rotation)
    run(cell, MoveLinear(cell, arm=ARM[scene], target=raised, speed=0.2))


def eraser_height(cell: SimulatedCell) -> float:
    return float(cell.data.body(cell.scene.names[ERASER] + "/block").xpos[2])
