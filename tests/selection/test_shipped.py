"""What the shipped skills say of the shipped scenes before anything moves."""

from __future__ import annotations

import inspect
from functools import cache

import pytest

from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, find_library
from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.conditions import Individual
from skillc_model.skills import Primitive, SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.execution.selection.preflight import preflight
from skillc_runtime.execution.selection.python_targets import import_matching_primitive
from skillc_runtime.execution.selection.select import NoneSelected, SelectedImplementation, select_implementation
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import Change, ClearProperty
from skillc_runtime.world.state.world_state import WorldState

LAB, CORE = "http://example.org/lab#", "https://w3id.org/skillc/core#"
SKIROS, WIPING = "http://rvmi.aau.dk/ontologies/skiros.owl#", "https://w3id.org/skillc/wiping#"
HERE = Position("task.skill", 3, 1)


@cache
def library() -> SkillLibrary:
    """Compile the shipped library."""
    return compile_valid(find_library(SHIPPED / "wiping"))


@cache
def scene() -> WorldState:
    """Return the world of the iiwa."""
    return load_scene(catalogue.scene_path("iiwa_table"), library().vocabulary)


def call(skill: str, **arguments: str) -> tree.Call:
    """Call a skill with individuals of the scene."""
    values = {name: Individual(LAB + value) for name, value in arguments.items()}
    return tree.Call(skill=skill, implementation=None, arguments=values, out=None, source=HERE)


WIPE = call("Wipe", surface="Table-1", arm="Iiwa-1", gripper="Robotiq-1", tool="Eraser-1", robot="Robot-1")
PICK = call("Pick", arm="Iiwa-1", object="Eraser-1")


def refusals(body: tree.Node, *changes: Change) -> list[str]:
    """Return the refusals in the changed scene, as text."""
    return [str(refusal) for refusal in preflight(body, library(), scene().with_changes(changes))]


def test_the_whole_scene_lets_both_skills_run() -> None:
    assert refusals(WIPE) == refusals(PICK) == []


@pytest.mark.parametrize(
    ("body", "thing", "property_", "what"),
    [
        (WIPE, "Table-1", WIPING + "normalForce", "Push: `force`"),
        (WIPE, "Table-1", SKIROS + "SizeX", "MoveLinear: `target`"),
        (WIPE, "Eraser-1", SKIROS + "SizeY", "FollowPath: `path`"),
    ],
)
def test_a_missing_fact_is_named(body: tree.Node, thing: str, property_: str, what: str) -> None:
    found = refusals(body, ClearProperty(LAB + thing, property_))
    short = library().vocabulary.short
    lacking = f"{what} has no value: {short(LAB + thing)} has no {short(property_)} in the world model"
    assert any(lacking in refusal for refusal in found), found


def test_a_place_that_measuring_may_supply_is_no_reason() -> None:
    assert refusals(WIPE, ClearProperty(LAB + "Table-1", SKIROS + "PositionX")) == []


def test_the_three_finger_gripper_takes_what_its_sheet_says() -> None:
    hand = {"gripper": LAB + "Robotiq-1", "opening": 0.05}
    choice = select_implementation(library(), "ActuateGripper", hand, scene())
    assert isinstance(choice, SelectedImplementation) and choice.bindings["force"] == 30.0
    weak = select_implementation(library(), "ActuateGripper", hand | {"force": 29.0}, scene(), fixed="robotiq")
    assert isinstance(weak, NoneSelected) and "29 N is below 30 N" in weak.rejected[0].reason


@pytest.mark.parametrize(
    ("skill", "uses"), [("ActuateGripper", ("gripper",)), ("Grasp", ("gripper",)), ("Release", ("arm", "gripper"))]
)
def test_whoever_moves_the_fingers_has_the_gripper_alone(skill: str, uses: tuple[str, ...]) -> None:
    assert library().skills[skill].uses == uses


def test_every_primitive_names_the_parameters_that_its_skill_gives() -> None:
    bodies = [(each.body, each.parameters) for each in library().implementations.values()]
    primitives = [(body.python, parameters) for body, parameters in bodies if isinstance(body, Primitive)]
    assert len(primitives) > 10
    for python, parameters in primitives:
        _, *taken = inspect.signature(import_matching_primitive(python, parameters)).parameters.values()
        assert all(each.kind is each.KEYWORD_ONLY for each in taken), python
