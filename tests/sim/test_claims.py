"""Nothing is claimed that did not happen: a bouncing pad, an obstacle, a part let go in the air, one that slips."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import inf

import numpy as np
import pytest
from msgspec.structs import replace

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_compiler.goals.parsing import parse_call
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.variation.variation import Variation, add_obstacles, draw_variation
from skillc_runtime.evaluation.trials.trial_cell import draw_disturbed_variation
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import (
    BASE_FRAME_ID,
    CONTACT_SHARE,
    CONTAIN,
    COVERAGE,
    FRAME_ID,
    FRICTION,
    HAS_A,
    IS_CLEAN,
    LEAST_CONTACT,
    ORIENTATION,
    POSITION,
    SKIROS,
    WEIGHT,
)
from skillc_runtime.world.state.world_state import WorldState

pytestmark = pytest.mark.sim

LAB = "http://example.org/lab#"
Reality = Callable[[SceneSpec, int], Variation]


@cache
def library() -> SkillLibrary:
    outcome = libraries.compile_library(find_library(SHIPPED / "wiping"))
    assert outcome.ok
    return outcome.value


@cache
def scene(task: str) -> WorldState:
    file = library().tasks[task].scene
    assert file is not None
    return load_scene(catalogue.scene_path(file), library().vocabulary)


def wiped(task: str, real: Reality = draw_variation, changes: tuple[Change, ...] = ()) -> Execution:
    """Run the plan of a task once, with changed facts; it is not made again when it fails."""
    goal, state = library().tasks[task].goal, scene(task).with_changes(changes)
    assert goal is not None
    planned = prepare_task(Assignment(task, state, AchieveGoal(goal)), library())
    assert isinstance(planned, PreparedTask), planned
    once = prepare_task(Assignment(task, state, ExecuteBody(planned.body)), library())
    assert isinstance(once, PreparedTask), once
    return execute_task(once, library(), SimulatedCell(WorldModel(state), 1, reality=real))


def stiff(facts: SceneSpec, seed: int) -> Variation:
    """Return a reality in which every pad is eight times as stiff as its data sheet says."""
    drawn = draw_variation(facts, seed)
    return replace(drawn, pad_share=dict.fromkeys(drawn.pad_share, 7.0))


LATE_S = 0.05
"""How late commands come to an arm that shakes: five times as late as its sheet allows for."""


def shaking(facts: SceneSpec, seed: int) -> Variation:
    """Return a reality with such a pad, and arms to which commands come too late."""
    drawn = stiff(facts, seed)
    return replace(drawn, imperfections={each.individual: {"commandDelay": (LATE_S,)} for each in facts.arms})


def test_a_pad_that_bounces_is_felt_and_the_wipe_fails() -> None:
    execution = wiped("clean_whiteboard", shaking, (SetProperty(LAB + "Whiteboard-1", LEAST_CONTACT, 0.95),))
    assert execution.status == "failed" and execution.failure is not None
    assert "contact with lab:Whiteboard-1 was lost for" in execution.failure.message
    assert execution.false_claims == ()
    after = execution.backend.world.snapshot()
    share = after.value(LAB + "Whiteboard-1", CONTACT_SHARE)
    assert isinstance(share, float) and share < 0.97
    assert after.value(LAB + "Whiteboard-1", IS_CLEAN) is False


def test_a_pad_that_would_bounce_is_kept_on_its_surface_by_what_energy_the_arm_gives(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """That it is stiff is not noticed here; without the tank it lost contact for two thirds of the time."""
    monkeypatch.setattr("skillc_runtime.control.laws.forward_dynamics.stiffest_contact", lambda *_: inf)
    execution = wiped("clean_whiteboard", stiff)
    assert execution.status == "succeeded" and execution.verified, execution.failure
    assert execution.false_claims == ()
    truth = execution.backend.ground_truth.recording(LAB + "Eraser-1")
    ends = truth.time[truth.on_surface > 1.0][-1]
    pressed = truth.on_surface[(truth.time > ends - 30.0) & (truth.time < ends - 1.0)]
    assert np.median(pressed) == pytest.approx(8.0, rel=0.05) and float((pressed > 4.0).mean()) > 0.99
    assert truth.force.max() < 30.0


def test_an_obstacle_is_not_taken_for_the_surface() -> None:
    execution = wiped("clean_desk", lambda facts, seed: add_obstacles(draw_variation(facts, seed), facts))
    assert execution.status == "failed"
    assert execution.failure is not None and "lab:Desk-1.isClean is false" in execution.failure.message
    after = execution.backend.world.snapshot()
    coverage = after.value(LAB + "Desk-1", COVERAGE)
    assert isinstance(coverage, float) and 0.5 < coverage < 1.0, "what the eraser reached is clean all the same"
    assert draw_disturbed_variation("obstacle", execution.backend.scene, 1).surfaces[0].obstacle is not None


PLACING = {FRAME_ID: "placing", BASE_FRAME_ID: "map"}
IN_THE_AIR = (*zip(POSITION, (0.48, -0.45, 0.8), strict=True), *zip(ORIENTATION, (0.0, 1.0, 0.0, 0.0), strict=True))


def moved(calls: tuple[str, ...], changes: tuple[Change, ...]) -> list[Execution]:
    """Run calls one after the other in the cell of the table, whose facts were changed before."""
    state = scene("clean_table").with_changes(changes)
    cell, executions = SimulatedCell(WorldModel(state)), []
    for text in calls:
        now = cell.world.snapshot()
        individuals = {each: sorted(now.types(each)) for each in now.individuals}
        call = parse_call(text, library(), individuals, now.vocabulary.prefixes)
        assert call.value is not None, call.diagnostics
        prepared = prepare_task(Assignment("move", now, ExecuteBody(call.value)), library())
        assert isinstance(prepared, PreparedTask), prepared
        executions.append(execute_task(prepared, library(), cell))
    return executions


PICK = "Pick(arm: lab:Iiwa-1, object: lab:Eraser-1)"


def test_a_part_that_nothing_supports_is_not_let_go() -> None:
    placing = LAB + "Cell-placing"
    facts = [SetProperty(placing, name, value) for name, value in (*PLACING.items(), *IN_THE_AIR)]
    there = (AddIndividual(placing, (SKIROS + "PlacingPose",)), AddRelation(LAB + "Cell", HAS_A, placing), *facts)
    picked, placed = moved((PICK, "Place(arm: lab:Iiwa-1, object: lab:Eraser-1, to: lab:Cell)"), there)
    assert picked.status == "succeeded" and picked.verified, picked.failure
    assert placed.status == "failed" and placed.failure is not None
    assert "nothing supports lab:Eraser-1 where it should stand at lab:Cell" in placed.failure.message
    after = placed.backend.world.snapshot()
    assert after.holds(LAB + "Robotiq-1", CONTAIN, LAB + "Eraser-1"), "it is still held"
    assert not after.holds(LAB + "Cell", CONTAIN, LAB + "Eraser-1")


def test_a_part_that_slips_out_while_it_is_carried_fails_the_run() -> None:
    heavy, believed_rough = SetProperty(LAB + "Eraser-1", WEIGHT, 6.2), SetProperty(LAB + "Eraser-1", FRICTION, 2.0)
    (picked,) = moved((PICK,), (heavy, believed_rough))
    assert picked.status == "failed"
    assert picked.failure is not None and "lost lab:Eraser-1" in picked.failure.message
    assert not picked.backend.world.snapshot().holds(LAB + "Robotiq-1", CONTAIN, LAB + "Eraser-1")
