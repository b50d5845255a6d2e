"""An arm takes the camera on its flange to where it sees all of a thing, and the image from there is judged."""

from __future__ import annotations

from itertools import chain, islice

import numpy as np
import pytest
from cells import LAB, begin, cell, run, world

pytest.importorskip("cv2")

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.cameras.image_camera import PIXELS_PER_CELL, ImageCamera
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.execution.refinement.failure import SpaceFailure
from skillc_runtime.execution.refinement.needs import meet
from skillc_runtime.execution.refinement.situation import Situation, begin_at_home
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.look_at import LookAt
from skillc_runtime.primitives.primitive import SkillFailure, SpaceLacking
from skillc_runtime.primitives.space_needs import PutFlange
from skillc_runtime.vision.cell_map import DIRTY, DIRTY_AMOUNT, UNSEEN
from skillc_runtime.vision.inspected_surface import marker_centres
from skillc_runtime.vision.lens import project
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.image_facts import read_inspected
from skillc_runtime.world.space.wrist_camera import find_wrist_camera, list_viewpoints
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import SKIROS

SCENE = "iiwa_wrist_camera"
ARM, TABLE, EYE = (LAB + name for name in ("Iiwa-1", "Table-1", "Eye-1"))
FAR = [SetProperty(TABLE, SKIROS + "PositionX", 1.1)]
RUBBED_S = 6.0


def test_every_viewpoint_sees_the_whole_table_and_its_markers() -> None:
    state = world(SCENE)
    camera, table = find_wrist_camera(state, ARM), read_inspected(state, TABLE)
    assert camera is not None
    points = np.concatenate([table.corners, marker_centres(table)])
    groups = list(list_viewpoints(state, TABLE, camera.lens))
    assert len(groups) > 2
    for view in chain.from_iterable(group[::5] for group in groups):
        pixels = project(camera.lens, view.inverse() @ pose(state, TABLE), points)
        assert (pixels > 0).all() and (pixels < (camera.lens.width, camera.lens.height)).all()


@pytest.mark.slow
def test_from_above_an_arm_sees_all_of_a_table_and_what_is_dirty() -> None:
    there = cell(SCENE, 1)
    camera, dose = there.camera(), there.coverage[TABLE].dose
    assert isinstance(camera, ImageCamera)
    dose[10:70, 5:50] = RUBBED_S
    with pytest.raises(NoSuchDevice, match="does not show where lab:Table-1 is"):
        camera.look(TABLE)
    run(there, LookAt(there, arm=ARM, thing=TABLE, pace=0.5))
    seen = camera.look(TABLE)
    fine = camera.true_amounts(TABLE)
    rows, columns = (each // PIXELS_PER_CELL for each in fine.shape)
    dirty = fine.reshape(rows, PIXELS_PER_CELL, columns, PIXELS_PER_CELL).mean(axis=(1, 3)) >= DIRTY_AMOUNT
    found = seen.state == DIRTY
    assert (seen.state == UNSEEN).mean() < 0.01
    assert 300 < (found & dirty).sum() >= 0.98 * max(found.sum(), dirty.sum())
    believed = camera.take_photo(pose(there.world.snapshot(), TABLE)).camera
    assert np.linalg.norm(believed.position - seen_from(there).position) < 3e-3, "it is off by the error of its mount"


@pytest.mark.slow
def test_an_arm_without_a_camera_or_a_place_to_look_from_says_so() -> None:
    there = cell("iiwa_table")
    with pytest.raises(SkillFailure, match=r"lab:Iiwa-1 has no camera on its flange: state `skillc:hasSensor`"):
        begin(LookAt(there, arm=ARM, thing=TABLE, pace=0.5))
    far = SimulatedCell(WorldModel(world(SCENE).with_changes(FAR)))
    with pytest.raises(SpaceLacking, match="no posture from which its camera sees all of lab:Table-1"):
        begin(LookAt(far, arm=ARM, thing=TABLE, pace=0.5))


@pytest.mark.slow
def test_what_a_camera_cannot_see_is_known_before_the_arm_moves() -> None:
    found = {}
    for state in (world(SCENE), world(SCENE).with_changes(FAR)):
        (need,) = LookAt.needs_space({"arm": ARM, "thing": TABLE}, state) or ()
        assert isinstance(need, PutFlange)
        found[state] = list(islice(meet(need, begin_at_home(state)), 8))
    near, far = found.values()
    assert any(isinstance(each, Situation) for each in near)
    (lost,) = far
    assert isinstance(lost, SpaceFailure)
    assert lost.cause == "out-of-reach"
    assert "no posture of lab:Iiwa-1 lets the camera on its flange see that" in lost.why


def seen_from(there: SimulatedCell) -> Pose:
    """Return where the camera really is: where the true flange brings it, but for the error of its mount."""
    flange = there.arms[ARM].flange_at(there.arms[ARM].state().q)
    spec = there.scene.image_camera
    assert spec is not None
    return there.arms[ARM].base @ flange @ spec.pose
