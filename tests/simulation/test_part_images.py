"""A camera of a simulated cell classifies parts by pixels, and says why where it cannot."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

pytest.importorskip("cv2")

from backends.kinematic_runs import library
from skillc.services.library.files import SHIPPED
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.cameras import photographer
from skillc_runtime.backends.simulation.cameras.image_camera import ImageCamera
from skillc_runtime.platforms.gl import RenderingError, make_gl_context
from skillc_runtime.primitives.inspect_part import InspectPart
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import Change, SetProperty
from skillc_runtime.world.state.facts import PropertyFact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CODE, CONFIDENCE, OF_KIND, SKILLC
from skillc_runtime.world.state.world_state import WorldState

pytestmark = pytest.mark.slow
LAB = "http://example.org/lab#"
PART_A, PART_B = LAB + "Part-A", LAB + "Part-B"


@pytest.fixture(scope="module", autouse=True)
def gl() -> None:
    """Skip where no GL library draws off screen."""
    try:
        _, context = make_gl_context(16, 16)
    except RenderingError as error:
        pytest.skip(str(error))
    context.free()


def world(changes: Sequence[Change] = ()) -> WorldModel:
    # Half as many pixels as the sheet has are rendered faster.
    state = load_scene(SHIPPED / "sorting" / "inspected.ttl", library("sorting").vocabulary)
    size = {"imageWidth": 960, "imageHeight": 720, "focalPixels": 1200.0}
    smaller = [SetProperty(SKILLC + "part-camera-sheet", SKILLC + name, value) for name, value in size.items()]
    return WorldModel(state.with_changes([*smaller, *changes]))


def inspect(cell: SimulatedCell | KinematicCell, part: str) -> tuple[str, WorldState]:
    primitive = InspectPart(cell, part=part, at=LAB + "Tray")
    primitive.start()
    primitive.tick()
    return primitive.outcome, cell.world.snapshot()


def test_what_pixels_say_of_parts_is_so_and_is_sensed_and_a_hidden_part_is_not_judged() -> None:
    cell = SimulatedCell(world(), seed=2)
    camera = cell.camera()
    assert isinstance(camera, ImageCamera)
    assert [camera.true_faces[each].defect for each in (PART_A, PART_B)] == ["", "spot"]
    assert inspect(cell, PART_A)[0] == "good"
    outcome, state = inspect(cell, PART_B)
    assert outcome == "scrap"
    assert (state.value(PART_B, CODE), state.objects(PART_B, OF_KIND)) == (204, {LAB + "Flange"})
    confidence = state.value(PART_B, CONFIDENCE)
    assert isinstance(confidence, float) and confidence > 0.99
    written = cell.world.deciding_write(PropertyFact(PART_B, CODE))
    assert written is not None and written.evidence == "sensed"
    # With the arm over the tray, nothing is guessed.
    cell.data.qpos[:7] = (-0.69, 0.5, 0.0, -1.7, 0.0, 2.2, 0.8)
    cell.refresh()
    before = cell.world.snapshot()
    with pytest.raises(SkillFailure, match="does not show what lab:Part-B is: something that is known"):
        inspect(cell, PART_B)
    assert cell.world.snapshot() is before


def test_without_images_nothing_is_known_of_parts_and_what_is_missing_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(width: int, height: int) -> None:
        raise RenderingError("no GL library draws off screen; on Debian: apt install libegl1")

    monkeypatch.setattr(photographer, "make_gl_context", refuse)
    with pytest.raises(SkillFailure, match=r"classified by images, and none is rendered: no GL library .* libegl1"):
        inspect(SimulatedCell(world()), PART_A)
    with pytest.raises(SkillFailure, match="only the back end mujoco renders"):
        inspect(KinematicCell(world()), PART_A)
