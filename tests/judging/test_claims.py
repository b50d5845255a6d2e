"""What the world model claims after a run is compared with the truth: what is so passes, what is not is named."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import mujoco
import numpy as np
import pytest

from backends.kinematic_runs import prepare
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.motion.pose import Pose, exp, quaternion_from_rotation
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.changes import AddRelation, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAIN, LOCATED
from skillc_runtime.world.state.world_state import WorldState

LAB = "http://example.org/lab#"
FOLDER = Path(__file__).parents[1] / "bodies" / "sorting"
BIN, PART, HAND = LAB + "Bin-A", LAB + "Part-A", LAB + "Hand-1"
IN_BIN = Pose.of((0.45, 0.15, 0.634))


@cache
def library() -> SkillLibrary:
    return compile_valid(find_library(FOLDER))


@cache
def start() -> WorldState:
    return prepare(library(), "sort_parts", FOLDER / "cell.ttl").assignment.state


def cell_claiming(*holder: str) -> KinematicCell:
    """Return a cell in which nothing has moved, and that claims that the part is in a holder, at a place in the bin."""
    cell = KinematicCell(WorldModel(start()))
    for each in holder:
        cell.world.commit([*placement_changes(PART, IN_BIN), AddRelation(each, CONTAIN, PART)])
    return cell


def put(cell: KinematicCell, at: Pose) -> None:
    """Move the part, whatever anybody believes."""
    joint = cell.model.joint(part_name(cell.scene.names[PART], "free"))
    first = int(joint.qposadr[0])
    cell.data.qpos[first : first + 7] = [*at.position, *quaternion_from_rotation(at.rotation)]
    mujoco.mj_kinematics(cell.model, cell.data)


def false_claims(cell: KinematicCell) -> tuple[str, ...]:
    return cell.find_false_claims()


def test_what_is_as_the_scene_says_is_not_false() -> None:
    assert false_claims(cell_claiming()) == ()


def test_a_part_that_is_in_the_bin_is_not_false() -> None:
    cell = cell_claiming(BIN)
    put(cell, IN_BIN)
    assert false_claims(cell) == ()


@pytest.mark.parametrize(
    ("at", "sentence"),
    [
        (Pose.of((0.9, 0.15, 0.03)), "lies on the floor, 0.68 m away"),
        (Pose.of((0.45, 0.02, 0.63)), "lies on lab:Table, 0.05 m away"),
        (Pose.of((0.45, 0.35, 0.634)), "lies in lab:Bin-B, 0.12 m away"),
    ],
)
def test_a_part_that_is_not_in_the_bin_is_named(at: Pose, sentence: str) -> None:
    cell = cell_claiming(BIN)
    put(cell, at)
    (found,) = false_claims(cell)
    assert found == f"lab:Part-A is claimed in lab:Bin-A but {sentence}"


def test_a_part_above_the_bin_is_not_in_it() -> None:
    cell = cell_claiming(BIN)
    put(cell, Pose.of((0.45, 0.15, 0.75)))
    assert "is at 0.45 0.15 0.75" in false_claims(cell)[0]


def test_a_hand_that_is_claimed_to_hold_what_lies_on_the_table() -> None:
    cell = KinematicCell(WorldModel(start()))
    cell.world.commit([AddRelation(HAND, CONTAIN, PART)])
    assert false_claims(cell) == ("lab:Part-A is claimed in lab:Hand-1 but lies on lab:Table",)


def test_a_part_that_is_elsewhere_or_has_fallen_over() -> None:
    cell = cell_claiming()
    put(cell, Pose.of((0.45, -0.25, 0.63)))
    assert false_claims(cell) == ("lab:Part-A is claimed at 0.45 -0.35 0.63 but lies on lab:Table, 0.10 m away",)
    put(cell, Pose(np.array([0.45, -0.35, 0.62]), exp(np.array([np.pi / 2, 0.0, 0.0]))))
    assert false_claims(cell) == ("lab:Part-A has fallen over: it is tilted by 90 deg against its claimed pose",)


def test_a_part_that_is_a_little_elsewhere_is_not_false() -> None:
    cell = cell_claiming()
    put(cell, Pose.of((0.47, -0.33, 0.63)))
    assert false_claims(cell) == ()


def test_a_part_that_is_known_to_be_elsewhere_is_not_claimed_where_it_was() -> None:
    cell = cell_claiming()
    put(cell, Pose.of((0.45, -0.25, 0.63)))
    cell.world.commit([SetProperty(PART, LOCATED, False)])
    assert cell.find_false_claims() == ()
