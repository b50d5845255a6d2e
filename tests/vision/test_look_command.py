"""`skillc look`: what a picture in a file shows of parts and surfaces, with the lens of a calibration."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

pytest.importorskip("cv2")

from part_pictures import COVER, LENS, face_with, look_down, photograph

import pictures
from skillc.cli.main import skillc
from skillc.services.library.files import SHIPPED
from skillc_runtime.motion.dirt_map import parse_dirt_map
from skillc_runtime.vision.inspected_surface import InspectedSurface, Markers, SurfaceLook
from skillc_runtime.vision.lens import Lens, read_calibration
from skillc_runtime.vision.picture import read_image, write_image

pytestmark = pytest.mark.slow
SCENE = str(SHIPPED / "sorting" / "inspected.ttl")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def look(*arguments: str) -> Result:
    return CliRunner().invoke(skillc, ("look", *arguments))


def write_calibration(lens: Lens, file: str = "ost.yaml") -> None:
    matrix = [lens.fx, 0.0, lens.cx, 0.0, lens.fy, lens.cy, 0.0, 0.0, 1.0]
    lines = (
        f"image_width: {lens.width}",
        f"image_height: {lens.height}",
        "camera_name: tray",
        f"camera_matrix:\n  rows: 3\n  cols: 3\n  data: {matrix}",
        f"distortion_coefficients:\n  rows: 1\n  cols: 4\n  data: {list(lens.distortion)}",
    )
    Path(file).write_text("\n".join(lines) + "\n", encoding="utf-8")


@pytest.mark.parametrize("defect", ["", "scratch"])
def test_a_picture_of_a_part_is_judged_and_drawn_over(defect: str) -> None:
    write_image(photograph(face_with(defect).reflectance, COVER.size, look_down()), "part.png")
    write_calibration(LENS)
    seen = look("part.png", "lab:Part-A", "--scene", SCENE, "--calibration", "ost.yaml", "-o", "seen.png")
    assert seen.exit_code == 0, seen.output
    assert f"117  lab:Cover  {'scrap' if defect else 'good'}, confidence" in seen.stdout
    assert (read_image("seen.png") != read_image("part.png")).any()


def test_what_is_not_decided_is_said_with_an_exit_code() -> None:
    write_image(photograph(face_with("", code=400).reflectance, COVER.size, look_down()), "part.png")
    write_calibration(LENS)
    seen = look("part.png", "lab:Part-A", "--scene", SCENE, "--calibration", "ost.yaml")
    assert (seen.exit_code, seen.stdout) == (3, "no kind of parts has the code 400 of the label that is seen\n")
    write_image(np.full((480, 640, 3), 90, dtype=np.uint8), "part.png")
    seen = look("part.png", "lab:Part-A", "--scene", SCENE, "--calibration", "ost.yaml", "--json")
    assert (seen.exit_code, json.loads(seen.stdout)) == (3, [])


def test_a_picture_of_a_surface_is_inspected_by_its_markers() -> None:
    table = InspectedSurface(np.array([0.3, 0.4]), SurfaceLook(), Markers(0.036))
    dirt = np.zeros((800, 600))
    dirt[:200] = 1.0
    write_image(pictures.take_photo(table, dirt).image, "table.jpg")
    write_calibration(pictures.LENS)
    seen = look("table.jpg", "lab:Table-1", "--scene", "iiwa_watched", "--calibration", "ost.yaml", "--json")
    assert seen.exit_code == 0, seen.output
    found = json.loads(seen.stdout)
    assert (found["surface"], found["located_by"]) == ("lab:Table-1", "markers")
    assert parse_dirt_map(found["dirt_map"]).dirty_share == pytest.approx(found["dirty"])
    assert found["dirty"] == pytest.approx(0.25, abs=0.02)
    write_image(np.full((480, 640, 3), 90, dtype=np.uint8), "table.jpg")
    lost = look("table.jpg", "lab:Table-1", "--scene", "iiwa_watched", "--calibration", "ost.yaml")
    assert lost.exit_code == 1 and "0 of its markers are seen, and 2 have to be" in lost.stderr


def test_mistakes_are_told() -> None:
    write_image(np.zeros((480, 640, 3), dtype=np.uint8), "part.png")
    Path("wrong.yaml").write_text("image_width: 640\n", encoding="utf-8")
    mistakes = {
        ("none.png", "lab:Part-A"): "cannot read none.png: No such file",
        ("wrong.yaml", "lab:Part-A"): "wrong.yaml is not an image that OpenCV reads",
        ("part.png", "lab:Part-Z"): "there is no individual lab:Part-Z",
        ("part.png", "lab:Table"): "lab:Table is no part, and no surface with markers",
        ("part.png", "lab:Part-A"): "an image of 1280 x 960 pixels in 8 bit colour is expected",
        ("part.png", "lab:Part-A", "--calibration", "wrong.yaml"): "wrong.yaml has no image_width, image_height and",
    }
    for arguments, words in mistakes.items():
        told = look(*arguments, "--scene", SCENE)
        assert told.exit_code == 2 and words in told.stderr, told.output


def test_a_calibration_of_ros_is_a_lens() -> None:
    lens = Lens(640, 480, 820.0, 818.0, 322.0, 238.0, (-0.1, 0.02, 0.0, 0.0))
    write_calibration(lens)
    assert read_calibration("ost.yaml") == lens
