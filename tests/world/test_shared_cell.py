"""An arm that may meet people is as slow, and pushes as gently, as the regions of their bodies bear."""

from __future__ import annotations

from math import inf, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.primitives.approach_speed import find_greatest_approach
from skillc_runtime.primitives.compliance import Push
from skillc_runtime.primitives.move import MoveLinear
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.shared_cell import UNSHARED, compute_greatest_speed, find_shared_limit
from skillc_runtime.world.state.changes import AddRelation, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import MAY_MEET, SKILLC
from skillc_runtime.world.state.world_state import WorldState

ARM = "http://example.org/lab#Panda-1"
POSITIVE = st.floats(0.1, 100.0)


@pytest.fixture(scope="module")
def alone() -> WorldState:
    vocabulary = load([Source(path, text) for path, text in catalogue.vocabulary_files()]).value
    return load_scene(catalogue.scene_path("panda_desk"), vocabulary)


def shared(state: WorldState, *regions: str) -> WorldState:
    return state.with_changes([AddRelation(ARM, MAY_MEET, SKILLC + each) for each in regions])


@given(POSITIVE, POSITIVE, POSITIVE, POSITIVE)
def test_the_energy_of_the_greatest_speed_is_that_of_the_greatest_force(
    force_n: float, stiffness: float, body_kg: float, robot_kg: float
) -> None:
    speed = compute_greatest_speed(force_n, stiffness, body_kg, robot_kg)
    reduced_kg = 1.0 / (1.0 / body_kg + 1.0 / robot_kg)
    assert reduced_kg * speed**2 / 2 == pytest.approx(force_n**2 / (2 * stiffness))
    assert compute_greatest_speed(force_n, stiffness, body_kg, 2 * robot_kg) < speed


def test_each_region_has_its_limit_and_the_weakest_counts(alone: WorldState) -> None:
    assert find_shared_limit(alone, ARM) == UNSHARED == find_shared_limit(alone, "http://example.org/lab#Nobody")
    hands = find_shared_limit(shared(alone, "Hands"), ARM)
    robot_kg = 16.1 / 2 + 0.12
    assert (hands.force_n, hands.weakest) == (140.0, SKILLC + "Hands")
    assert hands.speed_m_s == pytest.approx(280.0 / sqrt(75000.0 / (1 / 0.6 + 1 / robot_kg)))
    both = find_shared_limit(shared(alone, "Hands", "Chest"), ARM)
    assert (both.weakest, both.slowest) == (SKILLC + "Chest", SKILLC + "Chest") and both.speed_m_s < 1.0
    assert find_shared_limit(shared(alone, "Hands", "Face"), ARM).speed_m_s < 0.16


def test_what_people_do_not_bear_is_refused_before_anything_moves(alone: WorldState) -> None:
    face = shared(alone, "Face")
    problem = MoveLinear.find_problem({"arm": ARM, "speed": 0.2}, face)
    assert problem == ("`speed` is 0.2 m/s, more than the 0.14 m/s that skillc:Face bears, which lab:Panda-1 may meet")
    assert MoveLinear.find_problem({"arm": ARM, "speed": 0.2}, alone) is None
    assert Push.find_problem({"arm": ARM, "force": 30.0}, face) is None
    sensitive = face.with_changes([SetProperty(SKILLC + "Face", SKILLC + "quasiStaticLimit", 25.0)])
    problem = Push.find_problem({"arm": ARM, "force": 30.0}, sensitive)
    assert problem == "`force` is 30 N, more than the 25 N that skillc:Face bears, which lab:Panda-1 may meet"


def test_the_monitor_and_the_approach_know_it(alone: WorldState) -> None:
    face = shared(alone, "Face")
    assert find_greatest_approach(alone, ARM, 10.0) == inf, "nothing is held"
    assert find_greatest_approach(face, ARM, 10.0) == pytest.approx(find_shared_limit(face, ARM).speed_m_s)
    driver = SimulatedCell(WorldModel(face)).arm(ARM)
    assert driver.task_limits.speed_m_s == pytest.approx(find_shared_limit(face, ARM).speed_m_s)
    limits = driver._safety.limits  # type: ignore[attr-defined]
    assert limits.contact_force_n == 65.0 and limits.tool_speed_m_s == pytest.approx(driver.task_limits.speed_m_s)
