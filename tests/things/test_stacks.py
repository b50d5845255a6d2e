"""What rests on what, and what blocks what, are goals and conditions that plans reach and respect."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from backends.kinematic_runs import prepare
from skillc.cli.main import skillc
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.pipeline import compile as compile_sources
from skillc_dsl.source import Source
from skillc_model.conditions import Holds, Individual, Not
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.motion.pose import Pose
from skillc_runtime.planning.plan import Solved
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.space.frames import pose, relocation_changes
from skillc_runtime.world.state.changes import AddRelation, Change, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import BLOCKS, CONTAIN, FURNITURE, RESTS_ON, SHAPE, SIZE
from skillc_runtime.world.state.world_state import WorldState
from space.rooms import lab, thing

STACK = Path(__file__).parent / "stack"
TRAYS = Path(__file__).parent.parent / "bodies" / "trays"
TOWER = "lab:Block-A restsOn lab:Block-B and lab:Block-B restsOn lab:Block-C"


def plan(goal: str, library: Path = STACK, scene: Path | None = None, *options: str) -> dict:
    scene = scene or library / "cell.ttl"
    asked = ["plan", "--library", str(library), "--scene", str(scene), "--goal", goal, "--json", "--no-plan-cache"]
    return json.loads(CliRunner().invoke(skillc, [*asked, *options]).stdout)


def steps(answer: dict) -> list[str]:
    def show(step: dict) -> str:
        named = [step["arguments"].get(each, "").removeprefix("lab:") for each in ("object", "on", "to")]
        return " ".join([step["skill"], *filter(None, named)])

    return [show(each) for each in answer["plan"]]


def test_a_tower_is_built_from_below_and_what_stands_in_the_way_is_put_down_first() -> None:
    answer = plan(TOWER, STACK, None, "--no-geometry")
    assert steps(answer) == [
        "Pick Block-C",
        "Place Block-C Cell",
        "Pick Block-B",
        "PlaceOn Block-B Block-C",
        "Pick Block-A",
        "PlaceOn Block-A Block-B",
    ]
    assert answer["optimal"] == "proven"


@pytest.mark.parametrize(
    ("goal", "expected"),
    [
        ("lab:Block-C restsOn lab:Table", ["Pick Block-C", "PlaceOn Block-C Table"]),
        ("lab:Block-A restsOn lab:Table", []),
        ("not lab:Block-C restsOn lab:Block-A", ["Pick Block-C"]),
        ("not _ blocks lab:Block-A", ["Pick Block-C"]),
        ("lab:Block-B blocks lab:Block-C", ["Pick Block-B", "PlaceOn Block-B Block-C"]),
    ],
)
def test_goals_on_what_rests_where_are_planned(goal: str, expected: list[str]) -> None:
    assert steps(plan(goal, STACK, None, "--no-geometry")) == expected


@pytest.mark.slow
def test_the_steps_of_a_tower_go_in_space() -> None:
    answer = plan(TOWER)
    assert (answer["space"]["checked"], answer["space"]["failure"], len(answer["plan"])) == (6, None, 6)


def test_what_is_put_into_a_tray_rests_on_it() -> None:
    answer = plan("lab:Part-A restsOn lab:Tray-1", TRAYS, None, "--no-geometry")
    assert steps(answer) == ["Pick Part-A", "Place Part-A Tray-1"]


def test_nothing_rests_on_what_has_no_size() -> None:
    answer = plan("lab:Block-A restsOn lab:Cell")
    assert answer["status"] != "solved"
    assert "lab:Cell has no size, so nothing rests on it" in answer["failure"]


CRANE = """use skiros, rparts, skillc
skill Take {
    in    what: Product
    infer from: Location
    infer hand: GripperEffector
    pre   from contain what
    pre   hand canGrasp what
    pre   bare: not _ blocks what
    post  hand contain what
    post  not from contain what
}
impl take of Take { run python "skillc.primitives:StandIn" }
class Block < Product
"""


def test_conditions_of_skills_read_what_blocks_what() -> None:
    outcome = compile_sources([Source("stack.skill", CRANE)], load_vocabulary(), {}, "stack", {})
    assert not outcome.diagnostics, outcome.diagnostics
    state = load_scene(STACK / "cell.ttl", outcome.value.vocabulary)
    gone = Not(Holds(Individual(lab("Cell")), CONTAIN, Individual(lab("Block-A"))))
    answer = solve(outcome.value, state, gone, (AStar(),))
    assert isinstance(answer, Solved)
    assert [each.arguments["what"] for each in answer.plan.steps] == [lab("Block-C"), lab("Block-A")]


def load_stack() -> WorldState:
    return load_scene(STACK / "cell.ttl", compile_valid(find_library(STACK)).vocabulary)


def put_beside(state: WorldState, x: float, y: float, z: float, *changes: Change) -> WorldState:
    """Return a world in which Block-C is beside or above Block-A, where it blocks no other block."""
    there = pose(state, lab("Block-A")) @ Pose.of((x, y, z))
    moved = state.with_changes([*relocation_changes(state, lab("Block-C"), there), *changes])
    assert not moved.holds(lab("Block-C"), BLOCKS, lab("Block-B"))
    return moved


@pytest.mark.parametrize(
    ("z", "blocked", "why"),
    [
        (0.04, True, None),
        (0.06, True, None),
        (0.5, False, "lab:Block-C is 0.460 m above lab:Block-A, and lab:Hand-1 has room around lab:Block-A"),
    ],
)
def test_a_thing_blocks_what_it_stands_on_or_hangs_over(z: float, blocked: bool, why: str | None) -> None:
    state = put_beside(load_stack(), 0.0, 0.0, z)
    assert state.holds(lab("Block-C"), BLOCKS, lab("Block-A")) is blocked
    condition = Holds(Individual(lab("Block-C")), BLOCKS, Individual(lab("Block-A")))
    assert why is None or explain(condition, state, {}, state.vocabulary).endswith(why)
    carried = state.with_changes([AddRelation(lab("Block-A"), CONTAIN, lab("Block-C"))])
    assert not carried.holds(lab("Block-C"), BLOCKS, lab("Block-A")), "what a thing contains is taken along"


@pytest.mark.parametrize(("roof", "before_m", "blocked"), [(1, 0.083, True), (1, 0.3, False), (0, 0.083, False)])
def test_below_a_roof_a_thing_blocks_what_it_stands_before(roof: int, before_m: float, blocked: bool) -> None:
    place = pose(load_stack(), lab("Block-A")).position
    above = [
        *thing("Roof", Pose.of((*place[:2], 0.85)), size=(0.8, 0.8, 0.25), cls=FURNITURE),
        SetProperty(lab("Roof"), SHAPE, "table"),
    ]
    tall = [SetProperty(lab("Block-A"), SIZE[2], 0.12)]
    large = [SetProperty(lab("Block-C"), name, side) for name, side in zip(SIZE, (0.12, 0.12, 0.16), strict=True)]
    state = put_beside(load_stack(), -before_m, 0.0, 0.0, *tall, *large, *above * roof)
    assert state.holds(lab("Block-C"), BLOCKS, lab("Block-A")) is blocked


@pytest.mark.parametrize("backend", [pytest.param(SimulatedCell, marks=pytest.mark.sim), KinematicCell])
@pytest.mark.slow
def test_a_tower_is_built(backend: type[SimulatedCell | KinematicCell]) -> None:
    library = compile_valid(find_library(STACK))
    prepared = prepare(library, "tower", STACK / "cell.ttl")
    cell = backend(WorldModel(prepared.assignment.state))
    execution = execute_task(prepared, library, cell)
    assert execution.status == "succeeded", execution.failure
    state = cell.world.snapshot()
    for upper, lower in (("Block-A", "Block-B"), ("Block-B", "Block-C")):
        assert state.holds(lab(upper), RESTS_ON, lab(lower)) and state.holds(lab(upper), BLOCKS, lab(lower))
        gap = cell.ground_truth.body_pose(lab(upper)).position - cell.ground_truth.body_pose(lab(lower)).position
        assert gap == pytest.approx([0.0, 0.0, 0.04], abs=0.003)
