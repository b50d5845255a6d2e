"""A camera that takes images calls a table clean because of its pixels, and only as far as they show it."""

import logging

import numpy as np
import pytest
from cells import LAB, cell

pytest.importorskip("cv2")

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.cameras import photographer
from skillc_runtime.backends.simulation.cameras.camera import SimulatedCamera
from skillc_runtime.backends.simulation.cameras.image_camera import PIXELS_PER_CELL, ImageCamera
from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.arm_outline import find_arm_pixels
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.motion.dirt_map import CLEAN, DIRTY, UNSEEN
from skillc_runtime.motion.pose import Array
from skillc_runtime.platforms.gl import RenderingError, make_gl_context
from skillc_runtime.primitives.inspect import Inspect
from skillc_runtime.vision.cell_map import DIRTY_AMOUNT
from skillc_runtime.vision.opencv import load_opencv
from skillc_runtime.world.space.dirt import work_layout
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import ClearProperty, SetProperty
from skillc_runtime.world.state.terms import COVERAGE, DEVICE_STATE, IS_CLEAN, SKILLC

pytestmark = pytest.mark.slow
TABLE = LAB + "Table-1"
RUBBED_S = 6.0
"""A time under the tool that leaves nothing of the dirt: ten times that in which it falls to 1/e."""


@pytest.fixture(scope="module", autouse=True)
def gl() -> None:
    """Skip where no GL library draws off screen."""
    try:
        _, context = make_gl_context(16, 16)
    except RenderingError as error:
        pytest.skip(str(error))
    context.free()


def eye(there: SimulatedCell) -> ImageCamera:
    camera = there.camera()
    assert isinstance(camera, ImageCamera)
    return camera


def true_cells(camera: ImageCamera) -> Array:
    fine = camera.true_amounts(TABLE)
    rows, columns = (each // PIXELS_PER_CELL for each in fine.shape)
    return fine.reshape(rows, PIXELS_PER_CELL, columns, PIXELS_PER_CELL).mean(axis=(1, 3))


def inspect(there: SimulatedCell) -> None:
    primitive = Inspect(there, surface=TABLE)
    primitive.start()
    primitive.tick()


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_map_of_pixels_is_that_of_the_dirt(seed: int) -> None:
    there = cell("iiwa_watched", seed)
    dose = there.coverage[TABLE].dose
    dose[10:70, 5:50] = RUBBED_S  # well rubbed
    dose[:10, :20] = RUBBED_S / 10  # dirt falls to a third of what it was, which is still dirty
    camera = eye(there)
    seen, dirty = camera.look(TABLE), true_cells(camera) >= DIRTY_AMOUNT
    assert dirty[:4, :8].all()
    found = seen.state == DIRTY
    assert (found & dirty).sum() > 300
    assert (found & dirty).sum() >= 0.98 * found.sum(), "precision"
    assert (found & dirty).sum() >= 0.98 * (dirty & (seen.state != UNSEEN)).sum(), "recall"
    assert (seen.state == CLEAN).sum() > 500


def test_inspect_is_sensed_and_counts_only_what_is_seen() -> None:
    there = cell("iiwa_watched", 0)
    inspect(there)
    state = there.world.snapshot()
    assert state.value(TABLE, IS_CLEAN) is False
    assert state.value(TABLE, COVERAGE) < 0.02
    there.coverage[TABLE].dose[:] = RUBBED_S
    inspect(there)
    state = there.world.snapshot()
    assert state.value(TABLE, IS_CLEAN) is True
    assert there.camera().evidence == "sensed"


def test_what_an_image_shows_dirty_becomes_patches_until_it_is_clean() -> None:
    there = cell("iiwa_watched", 0)
    dose = there.coverage[TABLE].dose
    dose[:] = RUBBED_S
    dose[70:, :20] = 0.0  # 10 cm square, at the corner with the least x and the greatest y
    dose[:20, 40:] = 0.0  # another one, at the opposite corner
    inspect(there)
    layout = work_layout(there.world.snapshot(), TABLE)
    assert len(layout.patches) == 2
    inside = layout.work_mask(there.coverage[TABLE].x, there.coverage[TABLE].y)
    assert inside[70:, :20].all() and inside[:20, 40:].all()
    assert inside.mean() < 0.3
    dose[70:, :20] = RUBBED_S
    inspect(there)
    assert len(work_layout(there.world.snapshot(), TABLE).patches) == 1
    dose[:] = RUBBED_S
    inspect(there)
    state = there.world.snapshot()
    assert state.value(TABLE, IS_CLEAN) is True
    assert work_layout(state, TABLE).patches == ()


def test_an_arm_over_the_table_hides_what_is_below_it() -> None:
    there = cell("iiwa_watched", 0)
    there.coverage[TABLE].dose[:] = RUBBED_S
    camera = eye(there)
    assert camera.look(TABLE).seen_share > 0.95
    there.data.qpos[:7] = (0.1, 1.1, 0.0, -1.0, 0.0, 1.0, 0.0)
    there.refresh()
    seen = camera.look(TABLE)
    assert seen.seen_share < 0.9
    assert (seen.state != DIRTY).mean() > 0.99


def test_the_outlines_of_an_arm_cover_what_rendering_finds_of_it() -> None:
    there = cell("iiwa_watched", 0)
    there.data.qpos[:7] = (0.1, 1.1, 0.0, -1.0, 0.0, 1.0, 0.0)
    there.refresh()
    state, spec = there.world.snapshot(), there.scene.image_camera
    assert spec is not None
    photo = eye(there).take_photo(pose(state, TABLE))
    assembly = read_arm_assembly(state, LAB + "Iiwa-1", {LAB + "Robotiq-1": 0.08})
    base = photo.camera.inverse() @ pose(state, LAB + "Iiwa-1")
    covered = find_arm_pixels(assembly, there.data.qpos[:7].copy(), base, photo.lens)
    seen = np.asarray(load_opencv().erode(photo.hidden.astype(np.uint8), np.ones((61, 61), np.uint8)) > 0)
    assert seen.sum() > 3000, "well inside of the arm"
    assert (covered & seen).sum() > 0.99 * seen.sum()
    assert covered.mean() < 0.6


def test_nothing_is_claimed_of_a_table_without_markers_or_out_of_view() -> None:
    there = cell("iiwa_watched", 0)
    with pytest.raises(KeyError):
        there.camera().inspect(LAB + "Elsewhere")
    there.world.commit([SetProperty(TABLE, "http://rvmi.aau.dk/ontologies/skiros.owl#PositionX", 0.9)])
    with pytest.raises(NoSuchDevice, match=r"does not show where lab:Table-1 is: .* from where it is believed to be"):
        there.camera().inspect(TABLE)
    there.world.commit([ClearProperty(TABLE, SKILLC + "markerSize")])
    with pytest.raises(NoSuchDevice, match="rubbed"):
        there.camera().rubbed_share(TABLE, 1.0)


def test_without_a_gl_library_inspection_is_idealised_and_says_why(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def refuse(width: int, height: int) -> None:
        raise RenderingError("no GL library draws off screen; on Debian: apt install libegl1")

    monkeypatch.setattr(photographer, "make_gl_context", refuse)
    with caplog.at_level(logging.WARNING, "skillc"):
        there = cell("iiwa_watched")
    camera = there.camera()
    there.publish()
    assert there.world.snapshot().value(LAB + "Eye-1", DEVICE_STATE) == "Fault"
    assert isinstance(camera, SimulatedCamera)
    assert camera.evidence == "idealised"
    assert "apt install libegl1" in caplog.text
    assert "idealised" in caplog.text


def test_the_same_seed_gives_the_same_image() -> None:
    cells = [cell("iiwa_watched", seed) for seed in (3, 3, 4)]
    first, again, other = (eye(each).take_photo(pose(each.world.snapshot(), TABLE)).image for each in cells)
    assert (first == again).all()
    assert np.abs(first.astype(int) - other).mean() > 1
