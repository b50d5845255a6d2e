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
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.pose import Array
from skillc_runtime.recording.known_facts import KnownFact, format_evidence, format_unverified
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTACT_SHARE

pytestmark = pytest.mark.sim

ERROR_KG = 0.1


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


def wiped_with_error(error_n: float, returns: bool) -> tuple[Execution[SimulatedCell], float]:
    """Return a wipe during which a wrist reads too much, in N along its axis, and with which force in N it pressed.

    The error, in place of noise, begins once the arm yields. returns: whether it comes back when it is tared meanwhile,
    as it is just off the surface.
    """
    prepared, cell = start("clean_whiteboard")
    ((individual, arm),) = cell.arms.items()
    assert arm._wrist is not None
    noise, compliance, error = arm._wrist._noise, cell.arm(individual).compliance, np.zeros(9)
    release, tare = compliance.release, arm.tare

    def draw() -> None:
        noise.rows[:], noise.used[0] = error * compliance.released, 0.0

    def yield_with_error(along: Array, stiffness: float = 0.0) -> None:
        release(along, stiffness)
        error[2] = error[2] or error_n
        draw()

    def tare_with_error() -> None:
        tare()
        error[2] += error_n * (returns and compliance.released)
        draw()

    noise.draw, compliance.release, arm.tare = draw, yield_with_error, tare_with_error  # type: ignore[method-assign]
    ended = execute_task(prepared, library(), cell)
    (tool,) = cell.scene.tools
    truth = cell.ground_truth.recording(tool.individual)
    ends = truth.time[truth.on_surface > 1.0][-1]
    return ended, float(np.median(truth.on_surface[(truth.time > ends - 25.0) & (truth.time < ends - 1.0)]))


def test_a_force_that_is_measured_in_its_band_is_verified() -> None:
    prepared, cell = start("clean_whiteboard")
    ended = execute_task(prepared, library(), cell)
    assert ended.status == "succeeded" and ended.verified, ended.failure
    assert force_of(ended).known == "sensed" and ".pushForce == 8 N" in format_unverified(force_of(ended))
    (clean,) = (each for each in ended.facts if "isClean" in format_unverified(each))
    assert format_evidence(clean) == "idealised by Inspect, verified in simulation only"
    (surface,) = cell.scene.surfaces
    assert cell.world.snapshot().value(surface.individual, CONTACT_SHARE) == pytest.approx(1.0, abs=0.02)


ASSUMED = "lab:Ur5e-1.pushForce == 8 N is only assumed: the arm measured "


@pytest.mark.parametrize(
    ("error_n", "why"),
    [
        (0.6, "0.60 N when it touched nothing; less this error it pressed with 7.40 N for 8 N"),
        (1.0, "8.00 N for 8 N, but did not approach steadily for long enough to check that it measures 0 N when it"),
    ],
)
def test_a_wrist_that_reads_too_much_after_it_was_tared_verifies_nothing(error_n: float, why: str) -> None:
    """With 1 N too much a tool comes with half of its speed, which may be a contact already: nothing is measured."""
    ended, pressed_n = wiped_with_error(error_n, returns=True)
    assert ended.status == "succeeded" and ended.verified is False
    assert format_unverified(force_of(ended)).startswith(ASSUMED + why)
    assert pressed_n == pytest.approx(8.0 - error_n, abs=0.1)


def test_an_error_that_is_tared_just_off_the_surface_is_no_error_of_the_force() -> None:
    ended, pressed_n = wiped_with_error(1.0, returns=False)
    assert ended.status == "succeeded" and ended.verified
    assert pressed_n == pytest.approx(8.0, abs=0.1)


def test_a_tool_that_is_heavier_than_known_presses_as_hard_as_is_verified() -> None:
    """The arm corrects what it feels of the tool at rest."""
    prepared, cell = start("clean_desk")
    (tool,) = cell.scene.tools
    cell.model.body_mass[cell.model.body(part_name(cell.scene.names[tool.individual], "block")).id] += ERROR_KG
    ended = execute_task(prepared, library(), cell)
    assert ended.status == "succeeded" and ended.verified
    force = cell.ground_truth.recording(tool.individual).force
    assert np.median(force[force > 1.0]) == pytest.approx(10.0, rel=0.01)
