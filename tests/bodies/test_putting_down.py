"""Skills of users put things down: nothing is let go in the air, and what is met too early is not pressed on."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from bodies.test_own_cells import BACKENDS, CELLS, FOLDER, LAB, PICK_A, failure_of, place, written
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_compiler.goals.parsing import parse_call
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import Change, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAIN, IS_TAKEN, POSITION, WEIGHT

pytestmark = pytest.mark.slow

OWN = """
import "motion.skill"
import "gripper.skill"
use skillc, rparts

## Put `object` down as somebody does who lets go wherever the hand is.
skill PutDown {
    in    arm:     ArmDevice
    in    object:  Product
    in    to:      Location
    opt   drop:    Length = 0 cm  range 0 cm .. 50 cm
    infer gripper: GripperEffector
    pre   mounted: arm hasA gripper
    pre   held:    gripper contain object
    post  put:     to contain object
    post  free:    not gripper contain object
}

impl own of PutDown {
    refine arm: CompliantArm
    let    there = place_pose(arm, gripper, object, to)
    do seq {
        MoveTo(arm, target: raised(above_place(to, there), drop))
        MoveLinear(arm, target: raised(there, drop))
        Release(arm, gripper, object, to)
    }
}

## Put `object` down where nobody has measured how high the place is.
skill SetDown {
    in    arm:     ArmDevice
    in    object:  Product
    in    to:      Location
    infer gripper: GripperEffector
    pre   mounted: arm hasA gripper
    pre   held:    gripper contain object
    post  put:     to contain object
    post  free:    not gripper contain object
}

impl feeling of SetDown {
    refine arm: CompliantArm
    let    there = place_pose(arm, gripper, object, to)
    do seq {
        MoveTo(arm, target: above_place(to, there))
        MoveLinear(arm, target: raised(there, 1 cm))
        LowerUntilSupported(arm, object, to, travel: 10 cm)
        Release(arm, gripper, object, to)
    }
}

"""
PUT_DOWN = "PutDown(arm: lab:Panda-1, object: lab:Part-A, to: lab:Bin-A{})"
IN_THE_AIR = PUT_DOWN.format(", drop: 25 cm")
HAND, PART, BIN, OTHER = LAB + "Hand-1", LAB + "Part-A", LAB + "Bin-A", LAB + "Part-B"
POSES = """
lab:Cell skiros:hasA lab:Placing-1, lab:Placing-2 .
lab:Placing-1 a skiros:PlacingPose ; skiros:FrameId "p1" ; skiros:BaseFrameId "map" ; skillc:roll 180 ;
    skiros:PositionX 0.5 ; skiros:PositionY -0.05 ; skiros:PositionZ 0.6 .
lab:Placing-2 a skiros:PlacingPose ; skiros:FrameId "p2" ; skiros:BaseFrameId "map" ; skillc:roll 180 ;
    skiros:PositionX 0.6 ; skiros:PositionY -0.05 ; skiros:PositionZ 0.6 .

lab:Part-B a"""
TWO_POSES = [("\nlab:Part-B a", POSES)]
Cell = SimulatedCell | KinematicCell


@cache
def library(folder: Path) -> SkillLibrary:
    (folder / "sorting").mkdir()
    text = (FOLDER / "sorting.skill").read_text(encoding="utf-8").replace("task sort_parts", OWN + "task sort_parts")
    (folder / "sorting" / "sorting.skill").write_text(text, encoding="utf-8")
    return compile_valid(find_library(folder / "sorting"))


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> SkillLibrary:
    return library(tmp_path_factory.mktemp("own"))


def cell_of(
    scene: Path, compiled: SkillLibrary, reality: Sequence[Change], backend: type[Cell] = KinematicCell
) -> Cell:
    """Return a cell in which the facts of `reality` are true, and those of the scene are believed."""
    believed = load_scene(scene, compiled.vocabulary)
    cell = backend(WorldModel(believed.with_changes(reality)))
    facts = [(each.individual, each.property) for each in reality if isinstance(each, SetProperty)]
    cell.world.commit([SetProperty(one, name, believed.value(one, name)) for one, name in facts])  # type: ignore[arg-type]
    return cell


def carry_out(cell: Cell, compiled: SkillLibrary, text: str) -> Execution[Cell]:
    now = cell.world.snapshot()
    individuals = {each: sorted(now.types(each)) for each in now.individuals}
    call = parse_call(text, compiled, individuals, now.vocabulary.prefixes)
    assert call.value is not None, call.diagnostics
    prepared = prepare_task(Assignment("move", now, ExecuteBody(call.value)), compiled)
    assert isinstance(prepared, PreparedTask), prepared
    return execute_task(prepared, compiled, cell)


def picked(cell: Cell, compiled: SkillLibrary) -> Cell:
    ended = carry_out(cell, compiled, PICK_A)
    assert ended.status == "succeeded", ended.failure
    return cell


@pytest.mark.parametrize(
    ("arm", "backend"),
    [pytest.param("panda", SimulatedCell, marks=pytest.mark.sim), *((arm, KinematicCell) for arm in CELLS)],
)
def test_nothing_is_let_go_in_the_air(arm: str, backend: type[Cell], compiled: SkillLibrary, tmp_path: Path) -> None:
    cell = picked(cell_of(written(tmp_path, CELLS[arm]), compiled, [], backend), compiled)
    why = failure_of(carry_out(cell, compiled, IN_THE_AIR))
    assert "nothing supports lab:Part-A where it should stand at lab:Bin-A" in why
    after = cell.world.snapshot()
    assert after.holds(HAND, CONTAIN, PART) and not after.holds(BIN, CONTAIN, PART)
    assert cell.ground_truth.carried_by(HAND) == PART


@pytest.mark.sim
@pytest.mark.parametrize(
    ("arm", "known_kg", "drop", "why"),
    [
        ("panda", 0.55, ", drop: 25 cm", "nothing supports lab:Part-A where it should"),
        ("panda", 0.55, "", "rises while it is lowered, so it weighs less"),
        ("ur5e", 0.02, ", drop: 25 cm", "nothing supports lab:Part-A where it should"),
    ],
)
def test_a_part_of_which_the_weight_is_wrong_is_not_let_go(
    arm: str, known_kg: float, drop: str, why: str, compiled: SkillLibrary, tmp_path: Path
) -> None:
    """In the air an arm is tared, and feels that nothing carries the part; at the box it cannot tell, and says so."""
    cell = cell_of(written(tmp_path, CELLS[arm]), compiled, [], SimulatedCell)
    cell.world.commit([SetProperty(PART, WEIGHT, known_kg)])
    assert why in failure_of(carry_out(picked(cell, compiled), compiled, PUT_DOWN.format(drop)))
    assert cell.ground_truth.carried_by(HAND) == PART


@pytest.mark.parametrize("backend", BACKENDS)
def test_what_an_own_skill_puts_down_is_where_it_is_believed_to_be(
    backend: type[Cell], compiled: SkillLibrary, tmp_path: Path
) -> None:
    cell = picked(cell_of(written(tmp_path, []), compiled, [], backend), compiled)
    ended = carry_out(cell, compiled, PUT_DOWN.format(""))
    assert ended.status == "succeeded", ended.failure
    cell.advance(0.5)
    really = cell.ground_truth.body_pose(PART).position
    assert np.linalg.norm(pose(cell.world.snapshot(), PART).position - really) < 0.005


@pytest.mark.sim
@pytest.mark.parametrize("arm", ["panda", "iiwa"])
def test_an_own_skill_lowers_what_it_holds_until_something_carries_it(
    arm: str, compiled: SkillLibrary, tmp_path: Path
) -> None:
    cell = picked(cell_of(written(tmp_path, CELLS[arm]), compiled, [], SimulatedCell), compiled)
    known = cell.world.snapshot().value(BIN, POSITION[2])
    assert isinstance(known, float)
    cell.world.commit([SetProperty(BIN, POSITION[2], known + 0.05)])
    ended = carry_out(cell, compiled, "SetDown(arm: lab:Panda-1, object: lab:Part-A, to: lab:Bin-A)")
    assert ended.status == "succeeded", ended.failure
    cell.advance(0.5)
    really = cell.ground_truth.body_pose(PART).position
    assert np.linalg.norm(pose(cell.world.snapshot(), PART).position - really) < 0.005


MET = 60.0
"""N; a part that is led into a box with 10 cm/s is met by 180 N, with 3 cm/s by 45 N."""


@pytest.mark.sim
@pytest.mark.parametrize(
    ("arm", "call"),
    [("panda", PUT_DOWN.format("")), ("iiwa", place("Part-A", "Bin-A")), ("ur5e", place("Part-A", "Bin-A"))],
    ids=CELLS,
)
def test_a_box_that_stands_higher_than_believed_is_met_gently(
    arm: str, call: str, compiled: SkillLibrary, tmp_path: Path
) -> None:
    higher = [SetProperty(BIN, POSITION[2], 0.66)]
    cell = cell_of(written(tmp_path, CELLS[arm]), compiled, higher, SimulatedCell)
    assert isinstance(cell, SimulatedCell)
    picked(cell, compiled)
    felt = list[float]()

    def measure() -> None:
        force = cell.ground_truth.contact_force(HAND)
        assert force is not None
        felt.append(float(np.linalg.norm(force)))

    cell.live.listeners.append(measure)
    why = failure_of(carry_out(cell, compiled, call))
    assert "lab:Part-A touches something at a height of 0.63" in why
    assert "lab:Bin-A is believed to be 30 mm from there" in why
    assert 10.0 < max(felt) < MET
    assert np.mean(felt[-300:]) < 20.0, "it does not press on"
    assert cell.ground_truth.carried_by(HAND) == PART


def test_of_two_placing_poses_the_free_one_is_taken(compiled: SkillLibrary, tmp_path: Path) -> None:
    occupied = [SetProperty(OTHER, POSITION[1], -0.05)]
    cell = cell_of(written(tmp_path, TWO_POSES), compiled, occupied)
    cell.world.commit(occupied)
    ended = carry_out(picked(cell, compiled), compiled, place("Part-A", "Cell"))
    assert ended.status == "succeeded", ended.failure
    assert cell.ground_truth.body_pose(PART).position == pytest.approx((0.6, -0.05, 0.63), abs=0.005)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_placing_pose_at_which_something_was_felt_is_taken(
    backend: type[Cell], compiled: SkillLibrary, tmp_path: Path
) -> None:
    cell = cell_of(written(tmp_path, TWO_POSES), compiled, [SetProperty(OTHER, POSITION[1], -0.05)], backend)
    picked(cell, compiled)
    first = carry_out(cell, compiled, place("Part-A", "Cell"))
    assert "lab:Part-A touches something at a height of 0.6" in failure_of(first)
    assert "nothing is known to be there" in failure_of(first)
    assert cell.world.snapshot().value(LAB + "Placing-1", IS_TAKEN) is True
    second = carry_out(cell, compiled, place("Part-A", "Cell"))
    assert second.status == "succeeded", second.failure
    assert cell.ground_truth.body_pose(PART).position == pytest.approx((0.6, -0.05, 0.63), abs=0.005)


def test_where_all_placing_poses_are_taken_it_is_said_by_what(compiled: SkillLibrary, tmp_path: Path) -> None:
    cell = picked(cell_of(written(tmp_path, TWO_POSES), compiled, []), compiled)
    cell.world.commit([SetProperty(OTHER, POSITION[1], -0.05), SetProperty(LAB + "Placing-2", IS_TAKEN, True)])
    why = failure_of(carry_out(cell, compiled, place("Part-A", "Cell")))
    assert "lab:Part-B is at lab:Placing-1; something was felt at lab:Placing-2" in why
