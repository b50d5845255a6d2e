"""A force counts as verified only if it was measured in its band, by a signal that read nothing before contact."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.noise import Noise
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, PreparedTask, prepare_task
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.motion.pose import Array
from skillc_runtime.recording.known_facts import KnownFact, format_evidence, format_unverified
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTACT_SHARE

pytestmark = pytest.mark.sim

BIAS_N, ERROR_KG = 1.0, 0.1


@cache
def library() -> SkillLibrary:
    outcome = libraries.compile_library(find_library(SHIPPED / "wiping"))
    assert outcome.ok
    return outcome.value


def start(task: str) -> tuple[PreparedTask, SimulatedCell]:
    """Return a task whose plan is run once, and its cell."""
    goal, scene = library().tasks[task].goal, library().tasks[task].scene
    assert goal is not None and scene is not None
    state = load_scene(catalogue.scene_path(scene), library().vocabulary)
    planned = prepare_task(Assignment(task, state, AchieveGoal(goal)), library())
    assert isinstance(planned, PreparedTask), planned
    once = prepare_task(Assignment(task, state, ExecuteBody(planned.body)), library())
    assert isinstance(once, PreparedTask), once
    return once, SimulatedCell(WorldModel(state), 1)


def force_of(execution: Execution[SimulatedCell]) -> KnownFact:
    (found,) = (each for each in execution.facts if "pushForce" in format_unverified(each))
    return found


def bias(noise: Noise, arm: CompliantArmDriver) -> None:
    """Let a wrist have, in place of noise, a constant error of the force along its axis once the arm has yielded."""
    error = np.array([0.0, 0.0, BIAS_N, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    release = arm.compliance.release

    def draw() -> None:
        noise.rows[:], noise.used[0] = error * arm.compliance.released, 0.0

    def yield_with_error(along: Array, stiffness: float = 0.0) -> None:
        release(along, stiffness)
        draw()

    noise.draw, arm.compliance.release = draw, yield_with_error  # type: ignore[method-assign]


@pytest.mark.parametrize(("task", "wanted"), [("clean_whiteboard", "8 N"), ("clean_desk", "10 N")])
def test_a_force_that_is_measured_in_its_band_is_verified(task: str, wanted: str) -> None:
    prepared, cell = start(task)
    ended = execute_task(prepared, library(), cell)
    assert ended.status == "succeeded" and ended.verified, ended.failure
    assert force_of(ended).known == "sensed" and f".pushForce == {wanted}" in format_unverified(force_of(ended))
    (clean,) = (each for each in ended.facts if "isClean" in format_unverified(each))
    assert format_evidence(clean) == "idealised by Inspect, verified in simulation only"
    (surface,) = cell.scene.surfaces
    assert cell.world.snapshot().value(surface.individual, CONTACT_SHARE) == pytest.approx(1.0, abs=0.02)


def test_a_wrist_that_reads_a_newton_too_much_after_it_was_tared_verifies_nothing() -> None:
    prepared, cell = start("clean_whiteboard")
    ((individual, arm),) = cell.arms.items()
    assert arm._wrist is not None
    bias(arm._wrist._noise, cell.arm(individual))
    ended = execute_task(prepared, library(), cell)
    assert ended.status == "succeeded" and ended.verified is False
    assert format_unverified(force_of(ended)) == (
        "lab:Ur5e-1.pushForce == 8 N is only assumed: the arm measured 1.00 N when it touched nothing; less this error "
        "it pressed with 7.00 N for 8 N"
    )


def test_a_tool_that_is_heavier_than_known_presses_as_hard_as_is_verified() -> None:
    """The arm corrects what it feels of the tool at rest."""
    prepared, cell = start("clean_desk")
    (tool,) = cell.scene.tools
    cell.model.body_mass[cell.model.body(part_name(cell.scene.names[tool.individual], "block")).id] += ERROR_KG
    ended = execute_task(prepared, library(), cell)
    assert ended.status == "succeeded" and ended.verified
    force = cell.ground_truth.recording(tool.individual).force
    assert np.median(force[force > 1.0]) == pytest.approx(10.0, rel=0.01)
