"""Cells with boxes in the way, and how far the simulator says an arm really is from them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import mujoco
import numpy as np

from simulation import cells
from simulation.cells import ARM, LAB
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.names import box_geom_name
from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.collision_checker import CollisionChecker
from skillc_runtime.collision.collision_model import build_collision_model
from skillc_runtime.collision.path_planning import JointSpace
from skillc_runtime.collision.scenery import read_scenery
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.frames import placement_changes, pose
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.data_sheet import sheet_of
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import (
    FURNITURE,
    HAS_GRIPPER,
    HAS_POSTURE,
    HAS_SHEET,
    JOINT_VALUES,
    POSTURE_NAME,
    SIZE,
    SKILLC,
)
from skillc_runtime.world.state.world_state import WorldState

Numbers: TypeAlias = tuple[float, ...]


IN_THE_WAY = {"iiwa_table": (0.42, 0.33, 1.1), "ur5e_whiteboard": (0.54, 0.3, 1.15)}
"""The middle of the top of a pillar that the arm hits when it turns its first joint from home by `ASIDE_RAD`."""

ASIDE_RAD = 1.4

OWN = ("lab:Iiwa-1", "lab:Robotiq-1", "lab:Ur5e-1", "lab:Wsg-1")
"""What the names of the arms' parts begin with."""


def pillar(scene: str) -> list[Change]:
    """The changes that put `lab:Pillar` in the way."""
    x, y, height = IN_THE_WAY[scene]
    return box("Pillar", (x, y, height), (0.12, 0.12, height))


def aside(scene: str, turn: float = ASIDE_RAD) -> Array:
    """The home posture of an arm, its first joint turned, rad."""
    q = home(scene)
    q[0] += turn
    return q


def box(name: str, top: Numbers, size: Numbers) -> list[Change]:
    """The changes that put a box into the world, the middle of its top at a place."""
    thing = LAB + name
    sizes = [SetProperty(thing, key, value) for key, value in zip(SIZE, size, strict=True)]
    return [AddIndividual(thing, (FURNITURE,)), *sizes, *placement_changes(thing, Pose.of(top))]


def posture(scene: str, name: str, q: Sequence[float]) -> list[Change]:
    """The changes that let the sheet of a scene's arm know a posture."""
    thing, state = LAB + name, world(scene, [])
    known = [SetProperty(thing, POSTURE_NAME, name), SetProperty(thing, JOINT_VALUES, " ".join(map(str, q)))]
    (sheet,) = state.objects(ARM[scene], HAS_SHEET)
    return [AddIndividual(thing, (SKILLC + "Posture",)), AddRelation(sheet, HAS_POSTURE, thing), *known]


def world(scene: str, changes: list[Change]) -> WorldState:
    return cells.world(scene).with_changes(changes)


def cell(scene: str, changes: list[Change]) -> SimulatedCell:
    return SimulatedCell(WorldModel(world(scene, changes)))


def home(scene: str) -> Array:
    return sheet_of(world(scene, []), ARM[scene]).posture("home")


def contacts(scene: str, changes: list[Change]) -> tuple[CollisionChecker, JointSpace]:
    """What an arm can touch, and what else is known of it."""
    state, arm = world(scene, changes), ARM[scene]
    sheet = sheet_of(state, arm)
    openings = dict.fromkeys(state.objects(arm, HAS_GRIPPER), 0.05)
    shape = build_collision_model(read_arm_assembly(state, arm, openings), read_scenery(state, pose(state, arm)))
    postures = tuple(sheet.posture(name) for name in sheet.posture_names)
    return CollisionChecker(shape, sheet.posture("home")), JointSpace(
        shape.compiled.jnt_range[: shape.joints], postures
    )


def true_gap(there: SimulatedCell, scene: str, box_name: str) -> float:
    """How far in m, up to 5 cm, arm, gripper and what that holds really are from a box; below 0 inside."""
    model, mine = there.model, own_geoms(there, scene)
    other = model.geom(box_geom_name(there.scene.names[LAB + box_name])).id
    points = np.zeros(6)
    return min(mujoco.mj_geomDistance(model, there.data, geom, other, 0.05, points) for geom in mine)


def own_geoms(there: SimulatedCell, scene: str) -> list[int]:
    """The geoms of the arm and of its gripper."""
    facts = next(each for each in there.scene.arms if each.individual == ARM[scene])
    devices = [facts.individual, *([facts.gripper.individual] if facts.gripper else [])]
    prefixes = tuple(there.scene.names[each] + "/" for each in devices)
    bodies = there.model.geom_bodyid
    found = [g for g in range(there.model.ngeom) if there.model.body(bodies[g]).name.startswith(prefixes)]
    assert len(found) > 10
    return found
