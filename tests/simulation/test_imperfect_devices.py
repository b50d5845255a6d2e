"""Imperfect devices: what their sheets say is drawn, and has the effect that it has in real ones."""

import numpy as np
import pytest
from cells import ARM, LAB, SCENES, at_the_eraser, run, world
from hypothesis import given
from hypothesis import strategies as st

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.mujoco.wrist import WristFilter, filter_wrist, make_coupling
from skillc_runtime.backends.simulation.noise import BLOCK, Noise
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.backends.simulation.variation.variation import LEAST_MASS_SHARE, Variation, draw_variation
from skillc_runtime.devices.reality import KINDS, SHARES, parse_reality, set_reality
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.move import MoveJoints
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import REALITY, SKILLC

SEEDS = 40
ARM_OF = ARM["ur5e_whiteboard"]


def draw(scene: str, reality: str, seed: int) -> Variation:
    return draw_variation(read_scene_spec(set_reality(world(scene), reality)), seed)


def imperfect(scene: str, reality: str, seed: int = 0) -> SimulatedCell:
    return SimulatedCell(WorldModel(set_reality(world(scene), reality)), seed)


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("level", SHARES)
def test_sizes_are_within_the_range_of_the_sheet(scene: str, level: str) -> None:
    """A typical one is in the lower half; over many seeds they come near to both ends."""
    arm = ARM[scene]
    sheet = sheet_of(world(scene), arm)
    low, high = sheet.numbers("jointFriction")
    high = low + SHARES[level] * (high - low)
    drawn = [draw(scene, level, seed).imperfections[arm]["jointFriction"] for seed in range(SEEDS)]
    assert low <= np.min(drawn) < low + 0.1 * (high - low) < high - 0.1 * (high - low) < np.max(drawn) <= high


def test_one_kind_alone_is_as_it_is_among_all() -> None:
    """Each is drawn for itself, so that what one of them does can be looked at in the same run."""
    alone, among = (draw("ur5e_whiteboard", each, 3).imperfections for each in ("wide:forceBias", "wide"))
    assert alone == {ARM_OF: {"forceBias": among[ARM_OF]["forceBias"]}}
    assert len(among[ARM_OF]) > 5
    assert draw("ur5e_whiteboard", "wide", 3) == draw("ur5e_whiteboard", "wide", 3)
    assert draw("ur5e_whiteboard", "wide", 4).imperfections != among


def test_an_ideal_cell_is_as_if_nothing_had_been_said() -> None:
    assert draw("iiwa_table", "ideal", 5) == draw_variation(read_scene_spec(world("iiwa_table")), 5)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("bad", "reality is ideal, typical or wide, not 'bad'"),
        ("wide:", "there is no imperfection ''"),
        ("wide:jointFriction, rust", "there is no imperfection 'rust'; there are: forceBias"),
    ],
)
def test_what_it_may_be_is_said(text: str, problem: str) -> None:
    with pytest.raises(ValueError, match=problem):
        parse_reality(text)


def test_a_range_that_is_none_refuses_the_scene() -> None:
    state = set_reality(world("iiwa_table"), "wide")
    sheet = sheet_of(state, ARM["iiwa_table"]).individual
    for wrong in ("0.1", "0.2 0.1", "-1 1"):
        bad = state.with_changes([SetProperty(sheet, SKILLC + "jointFriction", wrong)])
        with pytest.raises(SheetError, match="jointFriction of skillc:iiwa14-sheet must be the least and the greatest"):
            draw_variation(read_scene_spec(bad), 0)
    bad = state.with_changes([SetProperty(ARM["iiwa_table"], REALITY, "perfect")])
    with pytest.raises(SheetError, match="reality of lab:Iiwa-1: reality is ideal, typical or wide"):
        read_scene_spec(bad)


def test_what_would_change_nothing_is_refused() -> None:
    """The iiwa has no wrist sensor, so that its sheet says nothing of one."""
    with pytest.raises(ValueError, match="no arm or tool of the scene has the imperfections forceBias: state their ra"):
        set_reality(world("iiwa_table"), "wide:forceBias")


def test_a_wrist_has_bias_and_drift() -> None:
    """As drawn: a hand that hangs still, which an ideal sensor would show as 0."""
    there = imperfect("ur5e_whiteboard", "wide:forceBias,forceDrift", 1)
    sizes = there.variation.imperfections[ARM_OF]
    readings = []
    for _ in range(2):
        samples = []
        for _ in range(200):
            there.advance(0.005)
            arm = there.arms[ARM_OF]
            samples.append(arm._hand.in_base[3:6] @ arm.state().wrench[:3])
        readings.append(np.mean(samples, axis=0))
    bias, drift = (-np.array(sizes[each]) for each in ("forceBias", "forceDrift"))
    np.testing.assert_allclose(readings[0], bias + 0.5 * drift, atol=0.15)
    np.testing.assert_allclose(readings[1] - readings[0], drift, atol=0.15)


def test_drift_goes_on_from_block_to_block() -> None:
    noise = Noise(np.zeros(2), np.random.default_rng(0), np.array([1.0, 0.0]), np.array([0.0, 0.5]))
    samples = []
    for _ in range(2):
        noise.draw()
        samples += noise.rows.tolist()
    np.testing.assert_allclose(samples, [(1.0, 0.5 * number) for number in range(2 * BLOCK)])


@given(st.floats(0.01, 2.0), st.floats(0.001, 0.01))
def test_a_wrist_measures_in_steps_and_only_so_often(grain: float, period_s: float) -> None:
    """What it measures is a multiple of its resolution, next to what it was when it was measured last."""
    raw, readings, grains = np.zeros(9), np.zeros(9), np.concatenate([np.full(6, grain), np.zeros(3)])
    quiet, first = np.zeros((500, 9)), np.zeros(1)
    wrist = WristFilter(
        readings, np.zeros(9), np.zeros(9), raw, quiet, np.zeros(1), 1.0, 0.1, first, grains, period_s, np.zeros(1)
    )
    measured_s, seen = 0.0, 0
    for step in range(400):
        now, before = 0.001 * step, readings.copy()
        raw[:] = 3.0 * np.sin(20.0 * now + np.arange(9))
        assert filter_wrist(wrist, now) == 0
        if not np.array_equal(before, readings):
            assert step == 0 or now - measured_s >= period_s - 1e-6
            np.testing.assert_allclose(readings[:6] / grain, np.round(readings[:6] / grain), atol=1e-9)
            assert np.abs(readings - raw)[:6].max() <= grain / 2 + 1e-9
            np.testing.assert_allclose(readings[6:], raw[6:], atol=1e-12)
            measured_s, seen = now, seen + 1
    assert seen > 0.3 / (period_s + 0.001)


def test_coupling_mixes_forces_with_forces_and_torques_with_torques() -> None:
    coupling = make_coupling({"forceGainError": (0.1,) * 6, "forceCrossTalk": tuple(np.arange(1, 13) / 100)})
    np.testing.assert_array_equal(np.diag(coupling), 1.1)
    assert not coupling[:3, 3:].any() and not coupling[3:, :3].any()
    assert coupling[0, 1] == 0.01 and coupling[5, 4] == 0.12
    np.testing.assert_array_equal(make_coupling({}), np.eye(6))


def test_an_eraser_is_heavier_or_lighter_and_stiffer_than_is_known() -> None:
    eraser = LAB + "Eraser-1"
    there = imperfect("iiwa_table", "wide:massError,padStiffnessFactor", 2)
    tool = next(each for each in there.scene.tools if each.individual == eraser)
    (error,), (factor,) = (there.variation.imperfections[eraser][each] for each in ("massError", "padStiffnessFactor"))
    assert float(there.model.body_subtreemass[there.model.body("lab:Eraser-1/block").id]) == pytest.approx(
        max(tool.mass_kg + error, LEAST_MASS_SHARE * tool.mass_kg)
    )
    assert there.variation.pad_stiffness(tool) > tool.sheet.number("padStiffness")
    assert 1.0 <= factor <= 10.0


@pytest.mark.parametrize("scene", SCENES)
def test_an_arm_takes_its_own_model_for_what_is(scene: str) -> None:
    """Base and links are elsewhere by some mm and encoders are off: it knows nothing of that, and measures as ever."""
    known = SimulatedCell(WorldModel(world(scene)), 3)
    there = imperfect(scene, "wide:mountingOffset,mountingTurn,linkOffset,linkTurn,transmissionError", 3)
    ideal, arm = known.arms[ARM[scene]], there.arms[ARM[scene]]
    arm._q[:] = ideal._q
    there.refresh()
    measured = arm.state()
    away = np.linalg.norm(known.data.xpos[ideal._link] - there.data.xpos[arm._link])
    assert 0.0005 < away < 0.02
    assert np.abs(measured.q - ideal._q).max() > 1e-5
    ideal._q[:] = measured.q
    known.refresh()
    expected = ideal.state()
    np.testing.assert_allclose(measured.tool.position, expected.tool.position, atol=2e-5)
    np.testing.assert_allclose(measured.tool.rotation, expected.tool.rotation, atol=2e-5)
    np.testing.assert_array_equal(arm.base.numbers, ideal.base.numbers)


def test_a_tool_has_its_centre_and_its_pad_elsewhere() -> None:
    models = [
        imperfect("iiwa_table", f"wide:{kinds}", 2)
        for kinds in ("padStiffnessFactor", "padStiffnessFactor,centreError,padThicknessError,padDampingFactor")
    ]
    sizes = models[1].variation.imperfections[LAB + "Eraser-1"]
    centres, pads, dampings = [], [], []
    for each in models:
        block, felt = (each.model.body(f"lab:Eraser-1/{part}") for part in ("block", "felt"))
        centre = block.mass[0] * block.ipos + felt.mass[0] * felt.pos
        centres.append(centre / (block.mass[0] + felt.mass[0]))
        pads.append(felt.pos[2])
        dampings.append(each.model.joint("lab:Eraser-1/press").damping[0])
    assert pads[1] == pytest.approx(pads[0] - sizes["padThicknessError"][0])
    assert dampings[1] == pytest.approx(dampings[0] * sizes["padDampingFactor"][0])
    np.testing.assert_allclose((centres[1] - centres[0])[:2], sizes["centreError"][:2], rtol=1e-9)
    known = [each._hands[ARM["iiwa_table"]]._centre_error(LAB + "Eraser-1") for each in models]
    np.testing.assert_array_equal(known, [np.zeros(3), sizes["centreError"]])


def test_every_kind_has_a_property_of_a_sheet_and_a_row_in_the_docs(docs: str) -> None:
    stated = {each for each in KINDS if SKILLC + each.name in world("iiwa_table").vocabulary.properties}
    assert stated == set(KINDS)
    assert [each.name for each in KINDS if f"`{each.name}`" not in docs] == []


@pytest.fixture
def docs(request: pytest.FixtureRequest) -> str:
    return (request.config.rootpath / "docs" / "reality.md").read_text(encoding="utf-8")


def test_ideal_undoes_what_a_scene_says() -> None:
    said = world("iiwa_table").with_changes([SetProperty(ARM["iiwa_table"], REALITY, "wide")])
    assert draw_variation(read_scene_spec(said), 0).imperfections[ARM["iiwa_table"]]
    ideal = draw_variation(read_scene_spec(set_reality(said, "ideal")), 0).imperfections
    assert not any(ideal.values())


def test_an_arm_that_is_wrong_about_its_weight_feels_that_beside_its_goal_and_arrives() -> None:
    there = at_the_eraser("iiwa_table")
    driver, arm = there.arm(ARM["iiwa_table"]), there.arms[ARM["iiwa_table"]]
    arm.correct_bias(np.eye(7)[2] * 2.0)
    aside = driver.motion.stopping_pose()
    goal = Pose(aside.position + np.array([0.0, 0.2, 0.1]), aside.rotation)
    move = MoveJoints(there, arm=ARM["iiwa_table"], target=goal, pace=0.5)
    run(there, move)
    assert move._ended is not None, "it stood beside its goal at first"
