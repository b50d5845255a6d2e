"""Dirt is told from a clean surface in pictures that nothing rendered, and what is not seen is never called clean."""

import sys
from pathlib import Path

import numpy as np
import pytest
from msgspec import structs

pytest.importorskip("cv2")

from pictures import (
    LENS,
    PIXEL_M,
    SURFACE,
    Lighting,
    Photo,
    cell_amounts,
    draw_dirt,
    look_down,
    take_photo,
)
from skillc_runtime.motion.dirt_map import CLEAN, DIRTY, UNSEEN
from skillc_runtime.motion.pose import Pose, exp
from skillc_runtime.vision.cell_map import DIRTY_AMOUNT, CellMap
from skillc_runtime.vision.inspect_image import inspect_image
from skillc_runtime.vision.inspected_surface import encode, linear
from skillc_runtime.vision.locate import NotLocated
from skillc_runtime.vision.opencv import load_opencv
from skillc_runtime.vision.picture import draw_cells, read_image, write_image

pytestmark = pytest.mark.slow

CLEAN_TABLE = np.zeros((600, 800))


def look(photo: Photo, hidden: np.ndarray | None = None) -> CellMap:
    return inspect_image(photo.image, LENS, SURFACE, photo.believed, hidden)


@pytest.mark.parametrize(
    "light",
    [
        Lighting(),
        Lighting(0.35, (1.05, 0.95, 0.75), slope=(1.5, -1.0)),
        Lighting(0.6, (0.9, 0.95, 1.1), falloff=4.0, glare=(0.1, 0.05, 0.02, 0.6)),
        Lighting(0.7, shadow=(-0.05, 0.0, 0.04, 0.4)),
    ],
    ids=["even", "dim, warm and slanting", "spot with a reflection", "a shadow"],
)
def test_dirt_is_found_in_any_light(light: Lighting) -> None:
    photo = take_photo(SURFACE, draw_dirt(SURFACE, 7), light, seed=7)
    seen, dirty = look(photo), photo.amounts >= DIRTY_AMOUNT
    found = seen.state == DIRTY
    assert (found & dirty).sum() > 200
    assert (found & dirty).sum() >= 0.98 * found.sum(), "precision"
    assert (found & dirty).sum() >= 0.98 * (dirty & (seen.state != UNSEEN)).sum(), "recall"
    assert seen.seen_share > 0.85
    wrong = (found & ~dirty) | ((seen.state == CLEAN) & dirty)
    assert not wrong.any() or seen.confidence[wrong].mean() < seen.confidence[~wrong & (seen.state != UNSEEN)].mean()


@pytest.mark.parametrize(("amount", "state"), [(0.0, CLEAN), (1.0, DIRTY), (0.1, CLEAN), (0.4, DIRTY)])
def test_a_surface_that_is_the_same_all_over_is_known_by_the_white_of_its_markers(amount: float, state: int) -> None:
    seen = look(take_photo(SURFACE, np.full_like(CLEAN_TABLE, amount), Lighting(0.6, slope=(1.0, 0.5))))
    assert (seen.state == state).mean() > 0.99
    assert abs(np.nanmean(seen.amount) - amount) < 0.05


def test_what_an_arm_hides_is_not_seen() -> None:
    hidden = np.zeros((LENS.height, LENS.width), dtype=bool)
    hidden[0:250, 280:380] = True
    seen = look(take_photo(SURFACE, CLEAN_TABLE, arm=(280, 380, 0, 250)), hidden)
    assert 0.1 < 1.0 - seen.seen_share < 0.3
    assert (seen.state != DIRTY).all()
    unknown = look(take_photo(SURFACE, CLEAN_TABLE, arm=(280, 380, 0, 250)))
    assert unknown.clean_share <= seen.clean_share + 0.05, "an arm of which nobody knows is not clean either"


def test_what_a_reflection_covers_or_a_shadow_darkens_is_not_called_clean() -> None:
    seen = look(take_photo(SURFACE, CLEAN_TABLE, Lighting(0.7, glare=(0.0, 0.0, 0.02, 1.0))))
    assert seen.state[15, 20] == UNSEEN
    shaded = look(take_photo(SURFACE, CLEAN_TABLE, Lighting(0.7, shadow=(0.0, -0.05, 0.04, 0.5))))
    assert shaded.state[20, 20] == UNSEEN
    assert (shaded.state == DIRTY).mean() < 0.01


def test_dirt_of_an_unknown_colour_is_not_clean() -> None:
    amount = np.zeros_like(CLEAN_TABLE)
    amount[200:400, 300:500] = 1.0
    for colour in ((150.0, 150.0, 150.0), (200.0, 60.0, 60.0), (60.0, 90.0, 200.0)):
        stained = structs.replace(SURFACE, look=structs.replace(SURFACE.look, dirt=colour))
        seen = look(take_photo(stained, amount))
        assert (seen.state[11:19, 16:24] != CLEAN).all(), colour
        assert (seen.state[:8] == CLEAN).mean() > 0.95


def test_markers_correct_a_pose_that_is_a_centimetre_and_a_degree_off() -> None:
    photo = take_photo(SURFACE, draw_dirt(SURFACE, 3), error=(0.01, 0.03), seed=3)
    assert np.linalg.norm(photo.believed.position - photo.true.position) > 0.005
    located = look(photo).located
    assert (located.by, located.markers) == ("markers", (0, 1, 2, 3))
    assert np.linalg.norm(located.pose.position - photo.true.position) < 0.001


def test_edges_correct_it_where_there_are_no_markers_and_the_light_is_stated() -> None:
    white = tuple(encode(0.7 * linear(SURFACE.look.paper)).tolist())
    bare = structs.replace(SURFACE, markers=None, white=white)
    photo = take_photo(bare, draw_dirt(bare, 4), seed=4)
    seen = inspect_image(photo.image, LENS, bare, photo.believed)
    assert seen.located.by == "edges"
    assert np.linalg.norm(seen.located.pose.position - photo.true.position) < 0.001
    assert ((seen.state == DIRTY) == (photo.amounts >= DIRTY_AMOUNT)).mean() > 0.99
    with pytest.raises(NotLocated, match="no white is stated"):
        inspect_image(photo.image, LENS, structs.replace(bare, white=None), photo.believed)


def test_a_marker_that_was_moved_is_left_out() -> None:
    photo = take_photo(SURFACE, CLEAN_TABLE, pose=look_down(tilt=(0.0, 0.0, 0.0)))
    image = photo.image.copy()
    image[:160, :180] = np.roll(image[:160, :180], 8, axis=1)
    located = inspect_image(image, LENS, SURFACE, photo.believed).located
    assert located.markers == (1, 2, 3)
    assert np.linalg.norm(located.pose.position - photo.true.position) < 0.003


def test_an_image_of_something_else_says_so() -> None:
    photo = take_photo(SURFACE, CLEAN_TABLE)
    with pytest.raises(NotLocated, match="0 of its markers are seen, and its edges do not stand out"):
        inspect_image(np.full_like(photo.image, 90), LENS, SURFACE, photo.believed)
    elsewhere = Pose(
        photo.believed.position + np.array([0.0, 0.0, 0.3]), exp(np.array([0.0, 0.0, 0.1])) @ photo.believed.rotation
    )
    with pytest.raises(NotLocated, match=r"mm and \d+ degrees from where it is believed to be"):
        inspect_image(photo.image, LENS, SURFACE, elsewhere)
    with pytest.raises(ValueError, match="640 x 480 pixels in 8 bit colour"):
        inspect_image(photo.image[:100], LENS, SURFACE, photo.believed)


def test_a_picture_in_a_file_is_inspected_and_the_map_is_drawn_over_it(tmp_path: Path) -> None:
    photo = take_photo(SURFACE, draw_dirt(SURFACE, 3))
    write_image(photo.image, tmp_path / "table.png")
    image = read_image(tmp_path / "table.png")
    assert (image == photo.image).all()
    seen = inspect_image(image, LENS, SURFACE, photo.believed)
    drawn = draw_cells(image, LENS, seen)
    for state, colour in ((CLEAN, (60, 170, 90)), (DIRTY, (210, 60, 40))):
        outlines = (np.abs(drawn.astype(int) - colour).max(axis=2) < 30).sum()
        assert outlines > 10 * (seen.state == state).sum() > 0
    (tmp_path / "no.png").write_text("text")
    with pytest.raises(ValueError, match=r"no\.png is not an image"):
        read_image(tmp_path / "no.png")
    with pytest.raises(ValueError, match="has no ending of a format"):
        write_image(image, tmp_path / "table")


def test_without_opencv_it_says_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cv2", None)
    with pytest.raises(ModuleNotFoundError, match=r"pip install 'skillc\[vision\]'"):
        load_opencv()


def test_the_truth_of_the_pictures_is_that_of_the_cells() -> None:
    amount = np.zeros_like(CLEAN_TABLE)
    amount[: round(0.01 / PIXEL_M), : round(0.005 / PIXEL_M)] = 1.0
    assert cell_amounts(SURFACE, amount)[0, 0] == 0.5
    assert cell_amounts(SURFACE, amount).sum() == 0.5
