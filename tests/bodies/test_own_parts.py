"""What is wrong about own parts and places is said in a sentence with numbers, before anything moves where possible."""

from __future__ import annotations

from functools import cache

import pytest

from backends.kinematic_runs import prepare
from bodies.test_sorting import FOLDER, LAB
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.pose import Pose
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.frames import placement_changes, pose
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import (
    CONTAIN,
    FRAME_ID,
    FRICTION,
    HAS_A,
    PLACING_POSE,
    PRODUCT,
    SIZE,
    WEIGHT,
)

PART, OTHER, BIN = LAB + "Part-A", LAB + "Part-B", LAB + "Bin-A"


@cache
def library() -> SkillLibrary:
    return compile_valid(find_library(FOLDER))


def sized(thing: str, *size: float) -> list[Change]:
    return [SetProperty(thing, name, each) for name, each in zip(SIZE, size, strict=True)]


def added(name: str, cls: str, place: tuple[float, float, float], size: tuple[float, float, float]) -> list[Change]:
    thing = LAB + name
    changes = [
        AddIndividual(thing, (cls,)),
        SetProperty(thing, FRAME_ID, name),
        AddRelation(LAB + "Cell", CONTAIN, thing),
    ]
    return [*changes, *placement_changes(thing, Pose.of(place)), *sized(thing, *size)]


def refusal(changes: list[Change]) -> str:
    state = load_scene(FOLDER / "cell.ttl", library().vocabulary).with_changes(changes)
    goal = library().tasks["sort_parts"].goal
    assert goal is not None
    return str(prepare_task(Assignment("sort_parts", state, AchieveGoal(goal)), library()))


def run(changes: list[Change]) -> Execution[KinematicCell]:
    prepared = prepare(library(), "sort_parts", FOLDER / "cell.ttl", changes)
    return execute_task(prepared, library(), KinematicCell(WorldModel(prepared.assignment.state)))


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        (
            sized(PART, 0.09, 0.09, 0.06),
            "lab:Part-A is 90 mm wide between the fingers, and lab:Hand-1 takes at most 74 mm: it opens to 80 mm",
        ),
        (
            [*sized(PART, 0.03, 0.03, 0.008)],
            "lab:Part-A is 8 mm high as it lies, and the fingers of lab:Hand-1 need 14 mm to hold it from above",
        ),
        (
            [SetProperty(PART, WEIGHT, 9.0)],
            "lab:Part-A weighs 9 kg, and with 70 N and a friction of 0.6 lab:Hand-1 carries at most 7.8 kg",
        ),
        (
            [SetProperty(PART, WEIGHT, 2.5)],
            "lab:Part-A weighs 2.5 kg and lab:Hand-1 0.73 kg, together more than the 3 kg that lab:Panda-1 carries",
        ),
        (
            [SetProperty(PART, FRICTION, 0.005)],
            "lab:Part-A weighs 0.15 kg, and with 70 N and a friction of 0.005 lab:Hand-1 carries at most 0.065 kg",
        ),
    ],
    ids=["wide", "flat", "heavy", "heavy for the arm", "slippery"],
)
def test_what_the_gripper_cannot_hold_is_refused_with_the_reason(changes: list[Change], reason: str) -> None:
    assert reason in refusal(changes)


@pytest.mark.slow
def test_a_part_nearly_as_wide_as_the_gripper_opens_is_sorted() -> None:
    execution = run(sized(PART, 0.07, 0.07, 0.06))
    assert execution.status == "succeeded", execution.failure


@pytest.mark.slow
def test_nothing_is_let_go_where_nothing_supports_it() -> None:
    place = LAB + "Bin-A-placing"
    in_the_air: list[Change] = [
        AddIndividual(place, (PLACING_POSE,)),
        AddRelation(BIN, HAS_A, place),
        *placement_changes(place, Pose.of((0.45, 0.15, 0.9), (0.0, 1.0, 0.0, 0.0))),
    ]
    execution = run(in_the_air)
    assert execution.failure is not None
    assert "nothing supports lab:Part-A where it should stand at lab:Bin-A" in execution.failure.message


@pytest.mark.slow
def test_parts_for_one_bin_lie_beside_each_other() -> None:
    there = added("Block", PRODUCT, (0.45, 0.15, 0.644), (0.04, 0.04, 0.08))
    execution = run([*sized(BIN, 0.32, 0.16, 0.06), *there])
    assert execution.status == "succeeded", execution.failure
    state = execution.backend.world.snapshot()
    assert abs(pose(state, PART).position[0] - 0.45) >= 0.02 + 0.01 + 0.02
