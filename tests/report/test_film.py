"""A film shows what a run did: arrows where hands press, surfaces as they are worked on, captions, and how it ended."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from msgspec.structs import replace
from PIL import Image

from simulation.cells import vocabulary
from skillc_ontology import catalogue
from skillc_runtime.backends.simulation.model.drawing import ModelDrawing
from skillc_runtime.backends.simulation.model.model_builder import build_model
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.variation.variation import Variation, exact_variation
from skillc_runtime.film.annotations import Annotations
from skillc_runtime.film.camera import CameraView, Projection, frame_points
from skillc_runtime.film.captions import STRIP_PIXELS, Caption, StripText, caption_at, draw_strip, shorten
from skillc_runtime.film.frames import FULL_DOSE_S, FULL_SHADE, LEAST_SHADE, shade
from skillc_runtime.film.framing import find_shots, posed
from skillc_runtime.film.labels import load_font
from skillc_runtime.film.picture_files import FilmError, LoopPictures
from skillc_runtime.film.render_film import CLEAN, DUSTY, colour_surface
from skillc_runtime.film.rendering import FILM_QUALITIES, Renderer, RenderingError, check_rendering
from skillc_runtime.film.windows import Spheres, Window, find_window, join_spheres
from skillc_runtime.film.workshop import find_texture, workshop_model
from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.scene.load import load_scene

WIDE = 1280


@pytest.mark.parametrize("seed", range(5))
def test_a_framed_point_is_in_the_picture_and_the_outermost_are_at_its_margin(seed: int) -> None:
    points = np.random.default_rng(seed).uniform(-1.0, 1.0, (30, 3))
    view = frame_points(points, 40.0 * seed, -25.0, 16 / 9)
    projection = Projection(view, 45.0, 1600, 900)
    seen = np.array([projection.pixel(each) for each in points])
    shares = np.abs(seen / (1600, 900) - 0.5) * 2
    assert (shares < 0.9).all()
    assert shares.max() == pytest.approx(0.88, abs=1e-6), "the camera is as close as the margin allows"


def test_what_is_behind_the_camera_is_not_in_the_picture() -> None:
    view = CameraView(np.zeros(3), 1.0, 0.0, 0.0)
    assert Projection(view, 45.0, 100, 100).pixel(np.array([-2.0, 0.0, 0.0])) is None
    assert Projection(view, 45.0, 100, 100).pixel(np.zeros(3)) == pytest.approx((50.0, 50.0))


def test_a_shot_ends_when_a_base_drives_and_a_short_stop_is_none() -> None:
    at = [0.0] * 20 + [0.1 * k for k in range(1, 9)] + [0.9] * 3 + [1.0] * 30
    assert find_shots([np.array([[x, 0.0, 0.0]]) for x in at]) == [range(20), range(31, 61)]
    assert find_shots([np.array([[x, 0.0, 0.0]]) for x in at[19:]]) == [range(1), range(12, 42)]
    assert find_shots([np.zeros((0, 3))] * 5) == [range(5)]


def test_a_surface_is_lighter_where_and_only_where_a_tool_worked() -> None:
    dose = np.zeros((4, 5))
    dose[1, 2], dose[3, 0] = FULL_DOSE_S, 0.01
    shades = shade(dose)
    assert (shades > 0).sum() == 2
    assert shades[1, 2] == FULL_SHADE and shades[3, 0] >= LEAST_SHADE
    colours = colour_surface(shades)
    assert colours[1, 2] == pytest.approx(CLEAN, abs=1.0)
    assert (colours[dose == 0] < np.array(DUSTY) + 20).all()
    np.testing.assert_array_equal(colours, colour_surface(shades), "the same dust in each picture")


def test_steps_that_run_at_once_are_in_one_caption() -> None:
    captions = (Caption("1/3 Drive", 0.0, 4.0), Caption("2/3 Pick", 2.0, 6.0), Caption("3/3 Wipe", 6.0, 9.0))
    assert [caption_at(captions, time) for time in (1.0, 3.0, 6.0, 9.0)] == [
        "1/3 Drive",
        "1/3 Drive  +  2/3 Pick",
        "3/3 Wipe",
        "",
    ]


def test_a_strip_has_its_texts_at_both_ends_and_a_long_one_does_not_reach_the_other() -> None:
    empty = draw_strip(StripText(""), WIDE)
    assert empty.shape == (STRIP_PIXELS, WIDE, 3)
    short = draw_strip(StripText("2/4  Wipe  Board 1", "", "presses with 8 N", "3.0 s"), WIDE)
    written = (short != empty).any(axis=(0, 2))
    assert written[:300].any() and not written[400:900].any() and written[1000:].any()
    long = draw_strip(StripText("x" * 300, "", "presses with 8 N", "3.0 s"), WIDE)
    alone = draw_strip(StripText("", "", "presses with 8 N", "3.0 s"), WIDE)
    first = int((alone != empty).any(axis=(0, 2)).argmax())
    np.testing.assert_array_equal(long[:, first - 20 :], alone[:, first - 20 :])
    assert not np.array_equal(draw_strip(StripText("failed", ending="failed"), WIDE)[0, 0], empty[0, 0])


def test_a_text_that_has_room_is_whole() -> None:
    from PIL import ImageDraw

    draw = ImageDraw.Draw(Image.new("RGB", (10, 10)))
    assert shorten(draw, "Wipe", 500.0, 31, True) == "Wipe"
    cut = shorten(draw, "Wipe the whole board", 150.0, 31, True)
    assert cut.endswith("…") and draw.textlength(cut, load_font(31, True)) <= 150.0


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["gif", "webp"])
def test_a_loop_is_smaller_than_its_limit_or_is_not_written(tmp_path: Path, suffix: str) -> None:
    rng, loop, file = np.random.default_rng(2), LoopPictures(), tmp_path / f"film.{suffix}"
    noise = [rng.integers(0, 255, (9, 16, 3), dtype=np.uint8) for _ in range(8)]
    kept = [np.kron(each, np.ones((80, 80, 1), dtype=np.uint8)) for each in noise]
    assert len(list(loop.keep(kept))) == 8
    with pytest.raises(FilmError, match=r"4 pictures make no loop of at most 0\.001 MB"):
        loop.write(file, 1000)
    assert not list(tmp_path.iterdir())
    loop.write(file)
    limit = file.stat().st_size - 1
    loop.write(file, limit)
    assert file.stat().st_size <= limit
    with Image.open(file) as image:
        assert (image.n_frames, image.info["loop"]) == (4, 0)
        assert image.size[0] < 800 and image.size[0] * 9 == pytest.approx(image.size[1] * 16, abs=16)


@pytest.mark.slow
@pytest.mark.parametrize(("x", "y"), [(0.15, 0.1), (-0.15, 0.1), (0.15, -0.1)])
def test_the_cell_that_was_worked_is_lighter_in_the_picture_where_it_is_in_the_world(x: float, y: float) -> None:
    try:
        check_rendering()
    except RenderingError as error:
        pytest.skip(str(error))
    scene = read_scene_spec(load_scene(catalogue.scene_path("iiwa_table"), vocabulary()))
    reality = exact_variation(scene)
    drawing = ModelDrawing(scene, reality, *_model_and_data(scene, reality))
    (surface,) = scene.surfaces
    covered = CoverageMap(surface.pose, surface.layout, 1.0)
    near = (np.abs(covered.x - x) < 0.03)[np.newaxis, :] & (np.abs(covered.y - y) < 0.03)[:, np.newaxis]
    model = workshop_model(drawing, None, {surface.individual: near.shape})
    view = CameraView(surface.pose.position, 1.5, 30.0, -60.0)
    renderer = Renderer(model, 640, 360)
    pictures = []
    for worked in (np.zeros(near.shape), near * FULL_DOSE_S):
        renderer.paint(find_texture(model, drawing, surface.individual), colour_surface(shade(worked)))
        pictures.append(renderer.picture(posed(model, drawing.posture()), view).astype(float))
    renderer.close()
    rows, columns = np.nonzero((pictures[1] - pictures[0]).mean(axis=2) > 20)
    expected = Projection(view, 45.0, 640, 360).pixel(surface.pose.apply(np.array([x, y, 0.0])))
    assert rows.size > 50
    assert (columns.mean(), rows.mean()) == pytest.approx(expected, abs=6.0)


@pytest.mark.slow
def test_the_rest_of_a_picture_need_not_be_drawn_again() -> None:
    """A picture after another one is that of a renderer that draws it first, but for roundings at edges."""
    try:
        check_rendering()
    except RenderingError as error:
        pytest.skip(str(error))
    scene = read_scene_spec(load_scene(catalogue.scene_path("iiwa_table"), vocabulary()))
    reality = exact_variation(scene)
    model, data = _model_and_data(scene, reality)
    drawing = ModelDrawing(scene, reality, model, data)
    drawn, (surface,) = workshop_model(drawing), scene.surfaces
    view = CameraView(surface.pose.position, 3.0, 30.0, -30.0)
    start = drawing.posture()
    moved = [replace(start, joints=start.joints + turn * (np.arange(model.nq) < 7)) for turn in (0.0, 0.02, 0.4)]
    trails = [Annotations(trails=(np.linspace([0.5, 0.0, 0.9], [0.5 + x, 0.1, 0.9], 5),)) for x in (0.1, 0.2, 0.3)]
    going_on, pixels = Renderer(drawn, 320, 180, quality=FILM_QUALITIES["standard"]), []
    shown = [going_on.picture(posed(drawn, at), view, trail) for at, trail in zip(moved, trails, strict=True)]
    going_on.close()
    for at, trail, picture in zip(moved, trails, shown, strict=True):
        first = Renderer(drawn, 320, 180, quality=FILM_QUALITIES["standard"])
        alone = first.picture(posed(drawn, at), view, trail)
        first.close()
        pixels.append(int((np.abs(alone.astype(int) - picture) > 8).any(axis=2).sum()))
    assert pixels[0] == 0 and max(pixels) < 10, "a few of 57600 pixels"
    assert (np.abs(shown[0].astype(int) - shown[1]) > 8).any(axis=2).sum() > 100, "it has moved"


def test_a_window_has_what_moves_and_its_shadow_and_nothing_if_nothing_moves() -> None:
    view, whole = CameraView(np.zeros(3), 4.0, 0.0, -30.0), Window(0, 0, 640, 360)
    projection = Projection(view, 45.0, 640, 360)
    ball = Spheres(np.array([[0.0, 0.0, 0.5]]), np.array([0.1]))
    shadow = ball.on_floor(np.array([0.6, 0.0, -0.8]))
    assert shadow.centres[0] == pytest.approx([0.375, 0.0, 0.0])
    found = find_window(join_spheres([ball, shadow]), view, projection)
    assert found is not None and found != whole
    for each in (ball, shadow):
        column, row = projection.pixel(each.centres[0]) or (0.0, 0.0)
        assert found.left < column < found.right and found.bottom < 360 - row < found.top
    at_camera = Spheres(view.position[np.newaxis], np.array([0.1]))
    assert find_window(at_camera, view, projection) == whole
    assert find_window(Spheres(np.zeros((0, 3)), np.zeros(0)), view, projection) is None


def _model_and_data(scene: SceneSpec, reality: Variation) -> tuple[Any, Any]:
    model = build_model(scene, reality)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data
