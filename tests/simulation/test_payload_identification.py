"""An arm finds out what the thing in its hand weighs, and where its centre of mass is."""

from __future__ import annotations

import numpy as np
import pytest
from cells import ARM, AT, ERASER, GRIPPER, LAB, grasp, lift, reach_for_eraser, run, world

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.reality import set_reality
from skillc_runtime.motion.pose import Array, exp
from skillc_runtime.primitives.identify_payload import IdentifyPayload
from skillc_runtime.primitives.payload_estimation import (
    MOST_CONDITION,
    LinkSample,
    LoadSample,
    estimate_by_links,
    estimate_by_wrist,
    weight_matrix,
)
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.facts import PropertyFact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import WEIGHT

SIM = pytest.mark.sim
KINDS = ("iiwa_table", pytest.param("ur5e_whiteboard", marks=SIM), pytest.param("panda_desk", marks=SIM))
TURNS = ((0, 0, 0), (0.8, 0, 0), (0, 0.8, 0), (-0.8, 0, 0), (0, -0.8, 0.5), (0.3, 0.3, 0))
EFFORT = np.array([300.0, 300.0, 150.0, 150.0, 40.0, 40.0, 40.0])


def lifted(scene: str, reality: str, seed: int) -> SimulatedCell:
    moved = [AddRelation(LAB + "Heron-1", AT, LAB + "Store")] if scene == "ur5e_whiteboard" else []
    there = SimulatedCell(WorldModel(set_reality(world(scene).with_changes(moved), reality)), seed)
    reach_for_eraser(there, scene, pace=0.4)
    grasp(there, scene)
    lift(there, scene, 0.2)
    return there


def identify(there: SimulatedCell, scene: str, tilt: float = 0.8) -> IdentifyPayload:
    skill = IdentifyPayload(there, arm=ARM[scene], gripper=GRIPPER[scene], object=ERASER, tilt=tilt, pace=0.4)
    run(there, skill, 60.0)
    return skill


@pytest.mark.parametrize("scene", KINDS)
def test_the_weight_of_a_tool_is_found_by_an_imperfect_arm(scene: str) -> None:
    there = lifted(scene, "typical", 5)
    true_kg = float(there.model.body_subtreemass[there.model.body(there.scene.names[ERASER] + "/block").id])
    assert abs(true_kg - 0.12) > 0.05
    note = identify(there, scene).note
    load = there.gripper(GRIPPER[scene]).load
    known = there.world.deciding_write(PropertyFact(ERASER, WEIGHT))
    assert known is not None and (known.evidence, known.origin) == ("sensed", "IdentifyPayload")
    assert load is not None and load.mass_kg == pytest.approx(true_kg, abs=0.02)
    assert "with a standard deviation of" in note


def test_turns_that_are_too_small_tell_nothing_and_nothing_is_written() -> None:
    scene = "iiwa_table"
    there = lifted(scene, "ideal", 0)
    before = there.world.snapshot().value(ERASER, WEIGHT)
    with pytest.raises(SkillFailure, match=r"taken to 8 of 8 postures, in which its weight cannot be told from the"):
        identify(there, scene, tilt=0.01)
    assert there.world.snapshot().value(ERASER, WEIGHT) == before


def _load(rng: np.random.Generator) -> tuple[Array, list[Array]]:
    payload = np.array([rng.uniform(-0.2, 1.0), *rng.uniform(-0.05, 0.05, 3)])
    return payload, [exp(np.array(each) + rng.uniform(-0.1, 0.1, 3)) for each in TURNS]


@pytest.mark.parametrize("seed", range(20))
def test_constant_errors_and_a_drift_of_a_wrist_do_not_count(seed: int) -> None:
    rng = np.random.default_rng(seed)
    payload, rotations = _load(rng)
    bias, drift = rng.uniform(-4, 4, 6), rng.uniform(-0.05, 0.05, 3)
    samples = []
    for at_s, turn in enumerate(rotations):
        wrist = bias + np.concatenate([drift * at_s, np.zeros(3)])
        samples.append(LoadSample(turn, weight_matrix(turn) @ payload + np.kron(np.eye(2), turn) @ wrist, float(at_s)))
    found = estimate_by_wrist(samples)
    assert found.condition < MOST_CONDITION
    np.testing.assert_allclose([found.mass_kg, *found.moment], payload, atol=1e-9)
    assert found.mass_deviation_kg < 1e-9


@pytest.mark.parametrize("seed", range(20))
def test_constant_errors_of_joints_and_a_wrong_own_weight_do_not_count(seed: int) -> None:
    rng = np.random.default_rng(seed)
    payload, rotations = _load(rng)
    bias, share, samples = 0.005 * EFFORT * rng.uniform(-1, 1, 7), rng.uniform(-0.03, 0.03), []
    for turn in rotations:
        own, jacobian = 0.2 * EFFORT * rng.uniform(-1, 1, 7), rng.uniform(-1, 1, (6, 7))
        samples.append(LinkSample(turn, jacobian.T @ weight_matrix(turn) @ payload + share * own + bias, own, jacobian))
    found = estimate_by_links(samples, EFFORT)
    np.testing.assert_allclose([found.mass_kg, *found.moment], payload, atol=1e-9)


def test_one_posture_tells_nothing() -> None:
    turn = exp(np.array([0.1, 0.2, 0.3]))
    same = [LoadSample(turn, np.ones(6), float(at_s)) for at_s in range(6)]
    assert estimate_by_wrist(same).condition == np.inf
