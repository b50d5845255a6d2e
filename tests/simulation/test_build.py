"""A model follows from the facts of a scene, as reality has them."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cells import ARM, ERASER, SCENES, SURFACE, cell, vocabulary, world

from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation import noise
from skillc_runtime.backends.simulation.model.model_builder import build_model
from skillc_runtime.backends.simulation.names import obstacle_name
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.backends.simulation.variation.variation import (
    OBSTACLE_M,
    add_obstacles,
    draw_variation,
    make_all_absent,
)
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import Change, ClearProperty, RemoveRelation, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import (
    COMPLIANT_CONTROLLER,
    FRICTION,
    FRICTION_HIGH,
    FRICTION_LOW,
    HAS_SHEET,
    JOINT_VALUES,
    OFFSET_RANGE,
    POSTURE_NAME,
    SIZE,
    SKILLC,
    TILT_RANGE,
    WEIGHT,
)

HOME = SKILLC + "iiwa14-home"
RANGES = (FRICTION_LOW, FRICTION_HIGH, OFFSET_RANGE, TILT_RANGE)


@pytest.mark.parametrize("scene", SCENES)
def test_everything_is_where_it_belongs(scene: str) -> None:
    built = cell(scene, seed=3)
    state, names = world(scene), built.scene.names
    arm, root = ARM[scene], {"iiwa_table": "base", "ur5e_whiteboard": "base_link"}[scene]
    np.testing.assert_allclose(built.data.body(f"{names[arm]}/{root}").xpos, pose(state, arm).position, atol=1e-9)
    for piece in built.scene.bodies:
        top = built.data.body(names[piece.individual])
        np.testing.assert_allclose(top.xpos, pose(state, piece.individual).position, atol=1e-9)
    surface = built.scene.surfaces[0]
    true, body = built.ground_truth.surface_pose(surface.individual), built.data.body(names[surface.individual])
    np.testing.assert_allclose(body.xpos, true.position, atol=1e-9)
    np.testing.assert_allclose(body.xmat.reshape(3, 3), true.rotation, atol=1e-9)
    friction = built.model.geom(f"{names[surface.individual]}/box").friction[0]
    assert friction == built.variation.of(surface.individual).friction


@pytest.mark.parametrize("scene", SCENES)
def test_the_arm_holds_its_posture_and_the_eraser_lies_still(scene: str) -> None:
    built = cell(scene)
    before = built.arm(ARM[scene]).measured.q
    built.advance(0.5)
    np.testing.assert_allclose(built.arm(ARM[scene]).measured.q, before, atol=1e-4)
    block = built.data.body(built.scene.names[ERASER] + "/block")
    np.testing.assert_allclose(block.xpos, pose(world(scene), ERASER).position, atol=2e-3)


def test_the_felt_yields_as_its_data_sheet_says() -> None:
    built = cell("iiwa_table")
    joint = built.model.joint(built.scene.names[ERASER] + "/press")
    (tool,) = built.scene.tools
    assert joint.stiffness[0] == built.variation.pad_stiffness(tool)
    assert abs(joint.stiffness[0] / tool.sheet.number("padStiffness") - 1) <= tool.stiffness_range
    weight = 9.81 * built.scene.tools[0].mass_kg
    built.advance(1.0)
    assert built.ground_truth.recording(ERASER).force.size == 0, "nothing is recorded of a tool that nobody holds"
    touch = built.data.sensor(built.scene.names[ERASER] + "/face/touch").data[0]
    assert touch == pytest.approx(weight, rel=0.01)


def test_a_missing_fact_is_named() -> None:
    state = world("iiwa_table").with_changes([ClearProperty(ERASER, WEIGHT)])
    with pytest.raises(SheetError, match=r"Eraser-1 has no number skiros:Weight"):
        read_scene_spec(state)


def test_a_device_without_data_sheet_is_named() -> None:
    arm = ARM["iiwa_table"]
    state = world("iiwa_table").with_changes([RemoveRelation(arm, HAS_SHEET, SKILLC + "iiwa14-sheet")])
    with pytest.raises(SheetError, match="Iiwa-1 has no data sheet"):
        read_scene_spec(state)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (ClearProperty(HOME, JOINT_VALUES), r"skillc:iiwa14-home has no skillc:jointValues"),
        (SetProperty(HOME, JOINT_VALUES, "0.0 zero"), r"posture home of skillc:iiwa14-sheet is not numbers"),
        (SetProperty(HOME, JOINT_VALUES, "0.0 0.1"), r"posture home of .* has 2 values; iiwa14.xml has 7 joints"),
        (SetProperty(HOME, POSTURE_NAME, "away"), r"skillc:iiwa14-sheet has no posture 'home'; it has away"),
    ],
)
def test_a_posture_that_cannot_be_taken_is_named(change: Change, message: str) -> None:
    with pytest.raises(SheetError, match=message):
        SimulatedCell(WorldModel(world("iiwa_table").with_changes([change])))


def test_an_unknown_controller_is_named_with_those_there_are() -> None:
    state = world("iiwa_table").with_changes([SetProperty(ARM["iiwa_table"], COMPLIANT_CONTROLLER, "impedence")])
    with pytest.raises(
        SheetError,
        match=r"Iiwa-1: there is no controller 'impedence'; .*forward_dynamics, forward_dynamics_velocity, impedance",
    ):
        SimulatedCell(WorldModel(state))


def test_a_plain_surface_with_nothing_but_its_friction_is_simulated(tmp_path: Path) -> None:
    """A surface need not be one to wipe."""
    text = catalogue.scene_path("iiwa_table").read_text("utf-8").replace("a wiping:TableTop", "a skillc:Surface")
    scene = tmp_path / "plain.ttl"
    scene.write_text(re.sub(r"wiping:isClean.*\n(.*\n)*", "skillc:friction 0.6 .\n", text), "utf-8")
    built = SimulatedCell(WorldModel(load_scene(scene, vocabulary())), seed=3)
    (surface,) = built.scene.surfaces
    assert (surface.friction, surface.offset_range_m, surface.tilt_range_rad) == ((0.6, 0.6), 0.0, 0.0)
    np.testing.assert_allclose(built.ground_truth.surface_pose(surface.individual).position, surface.pose.position)


@pytest.mark.parametrize(("given", "missing"), [(FRICTION_LOW, FRICTION_HIGH), (FRICTION_HIGH, FRICTION_LOW)])
def test_half_a_range_of_friction_is_refused(given: str, missing: str) -> None:
    state = world("iiwa_table").with_changes([ClearProperty(SURFACE["iiwa_table"], missing)])
    assert state.value(SURFACE["iiwa_table"], given) is not None
    with pytest.raises(SheetError, match=f"Table-1 has no number skillc:{missing.removeprefix(SKILLC)}"):
        read_scene_spec(state)


def test_a_range_of_friction_is_read_without_the_single_value_and_the_other_way_round() -> None:
    surface, state = SURFACE["iiwa_table"], world("iiwa_table")
    assert read_scene_spec(state.with_changes([ClearProperty(surface, FRICTION)])).surfaces[0].friction == (0.3, 0.8)
    bare = state.with_changes([ClearProperty(surface, name) for name in RANGES])
    assert read_scene_spec(bare).surfaces[0].friction == (0.6, 0.6)
    with pytest.raises(SheetError, match=r"Table-1 has no number skillc:friction "):
        read_scene_spec(bare.with_changes([ClearProperty(surface, FRICTION)]))
    with pytest.raises(SheetError, match=r"skillc:frictionLow above its skillc:frictionHigh"):
        read_scene_spec(state.with_changes([SetProperty(surface, FRICTION_LOW, 0.9)]))


def test_facts_that_contradict_a_model_are_refused() -> None:
    facts = read_scene_spec(world("iiwa_table").with_changes([SetProperty(ERASER, SIZE[0], 0.2)]))
    with pytest.raises(SheetError, match=r"the face of .*Eraser-1 is"):
        build_model(facts, draw_variation(facts, 0))


@pytest.mark.parametrize("scene", SCENES)
def test_reality_differs_within_the_ranges_of_the_facts(scene: str) -> None:
    facts = read_scene_spec(world(scene))
    (surface,) = facts.surfaces
    drawn = [draw_variation(facts, seed).of(SURFACE[scene]) for seed in range(100)]
    offsets = np.array([one.offset_m for one in drawn])
    tilts = np.array([one.tilt_rad for one in drawn])
    frictions = np.array([one.friction for one in drawn])
    assert 0.9 * surface.offset_range_m < np.abs(offsets).max() <= surface.offset_range_m
    assert 0.9 * surface.tilt_range_rad < np.abs(tilts).max() <= surface.tilt_range_rad
    assert surface.friction[0] <= frictions.min() < frictions.max() <= surface.friction[1]
    assert draw_variation(facts, 7) == draw_variation(facts, 7)


@pytest.mark.parametrize("scene", SCENES)
def test_arms_start_and_pads_yield_within_the_ranges_of_the_facts(scene: str) -> None:
    facts = read_scene_spec(world(scene))
    (arm,), (tool,) = facts.arms, facts.tools
    drawn = [draw_variation(facts, seed) for seed in range(100)]
    off = np.abs([one.start(arm) - arm.home for one in drawn])
    stiffer = np.array([one.pad_stiffness(tool) / tool.sheet.number("padStiffness") - 1 for one in drawn])
    assert (off.max(axis=0) > 0.9 * arm.posture_range_rad).all() and off.max() <= arm.posture_range_rad
    assert stiffer.min() < -0.9 * tool.stiffness_range and 0.9 * tool.stiffness_range < stiffer.max()
    assert np.abs(stiffer).max() <= tool.stiffness_range
    np.testing.assert_array_equal(cell(scene, 5).arm(arm.individual).measured.q, draw_variation(facts, 5).start(arm))


@pytest.mark.parametrize("scene", SCENES)
def test_what_an_arm_measures_is_as_noisy_as_the_facts_say_and_the_same_for_the_same_seed(scene: str) -> None:
    (arm,) = read_scene_spec(world(scene)).arms
    sources = (
        (noise.make_joint_noise(arm, 3), noise.make_wrist_noise(arm, 3)),
        (noise.make_joint_noise(arm, 3), noise.make_wrist_noise(arm, 3)),
    )
    wrist = [0.5] * 3 + [0.02] * 3 + [0.0] * 3
    wanted = {"iiwa_table": ([0.001] * 7, [0.0] * 9), "ur5e_whiteboard": ([0.0] * 6, wrist)}[scene]
    for one, again, deviation in zip(*sources, wanted, strict=True):
        rows, same = np.array([draw(one) for _ in range(3)]), np.array([draw(again) for _ in range(3)])
        np.testing.assert_allclose(rows.reshape(-1, len(deviation)).std(axis=0), deviation, rtol=0.1)
        np.testing.assert_array_equal(rows, same)
        assert not any(deviation) or not np.array_equal(rows[0], rows[1])


def draw(source: noise.Noise) -> Array:
    """Return the next block of noise."""
    source.draw()
    return source.rows.copy()


def test_surfaces_may_be_missing_and_may_carry_something() -> None:
    facts = read_scene_spec(world("iiwa_table"))
    drawn, name = draw_variation(facts, 2), facts.names[SURFACE["iiwa_table"]]
    bodies = {
        model.body(each).name for model in (build_model(facts, make_all_absent(drawn)),) for each in range(model.nbody)
    }
    assert name not in bodies
    littered = build_model(facts, add_obstacles(drawn, facts))
    here, top = littered.body(obstacle_name(name)).pos, littered.body(name)
    away = pose_of(top).inverse().apply(here)
    assert away[2] == pytest.approx(OBSTACLE_M[2])
    assert (np.abs(away[:2]) < facts.surfaces[0].size[:2] / 2).all()


def pose_of(body: Any) -> Pose:
    return Pose.of(body.pos, body.quat)
