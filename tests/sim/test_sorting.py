"""The shipped pick-and-place cells: derived grasps, parts that lie where they should in the end, seen or not."""

from __future__ import annotations

import numpy as np
import pytest

from backends.kinematic_runs import library, prepare
from skillc.services.library.files import SHIPPED
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.cameras.image_camera import ImageCamera
from skillc_runtime.evaluation.report.handlings import find_handlings, find_targets, measure_placements
from skillc_runtime.evaluation.report.run_trace import HandTrace
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.motion.pose import Pose
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.world.space.frames import pose, size
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAIN, MANIPULATABLE

pytestmark = pytest.mark.sim

PLACED_MM = 10.0
"""How far, in the plane, a part may really lie from its believed place, and from where it should be."""


@pytest.mark.parametrize(
    ("task", "scene", "parts", "verified"),
    [
        ("sort_seen_parts", "ur5e.ttl", 3, True),
        ("sort_shapes", "iiwa.ttl", 5, False),
    ],
)
def test_all_parts_lie_in_their_boxes_and_where_they_are_believed_to_be(
    task: str, scene: str, parts: int, verified: bool
) -> None:
    compiled = library("sorting")
    prepared = prepare(compiled, task, SHIPPED / "sorting" / scene)
    cell = SimulatedCell(WorldModel(prepared.assignment.state), seed=1)
    told, trace = HistoryBuilder(), HandTrace(cell)
    execution = execute_task(prepared, compiled, cell, [told], trace.sample)
    assert (execution.status, execution.verified) == ("succeeded", verified), execution.failure
    cell.advance(0.5)
    handlings = find_handlings(told.history, cell.world.snapshot())
    placements = measure_placements(cell.world, cell.ground_truth, find_targets(handlings))
    assert [each.missed_m is not None and 1e3 * each.missed_m <= PLACED_MM for each in placements] == [True] * parts
    for handling in handlings:
        held = trace.path(handling.gripper).between(handling.grasped_s + 0.2, handling.grasped_s + 1.0)
        assert held.finger_force == pytest.approx(30.0, abs=1.5)
        assert held.measured_opening == pytest.approx(held.opening, abs=2e-3)
    state, truth = cell.world.snapshot(), cell.ground_truth
    moved = sorted(state.instances(MANIPULATABLE))
    assert len(moved) == parts
    for part in moved:
        (box,) = state.subjects(CONTAIN, part)
        really = truth.body_pose(part)
        assert is_inside(truth.body_pose(box).inverse() @ really, size(state, box)), part
        away = pose(state, part).position - really.position
        assert 1e3 * np.linalg.norm(away[:2]) <= PLACED_MM, part


@pytest.mark.parametrize(
    ("task", "scene"), [("sort_inspected", "inspected.ttl"), ("sort_by_wrist_camera", "wrist_camera.ttl")]
)
def test_parts_go_where_pixels_say_and_pixels_are_right(task: str, scene: str) -> None:
    pytest.importorskip("cv2")
    compiled = library("sorting")
    prepared = prepare(compiled, task, SHIPPED / "sorting" / scene)
    cell = SimulatedCell(WorldModel(prepared.assignment.state), seed=2)
    camera = cell.camera()
    if not isinstance(camera, ImageCamera):
        pytest.skip("no GL library draws off screen")
    execution = execute_task(prepared, compiled, cell)
    assert (execution.status, execution.verified, execution.false_claims) == ("succeeded", True, ()), execution.failure
    state, truth = cell.world.snapshot(), cell.ground_truth
    defects = {part: face.defect for part, face in camera.true_faces.items()}
    assert sorted(defects.values()) == ["", "spot"]
    for part, defect in defects.items():
        box = f"http://example.org/lab#{'Scrap' if defect else 'Rack'}"
        assert is_inside(truth.body_pose(box).inverse() @ truth.body_pose(part), size(state, box)), part


def is_inside(in_box: Pose, extent: np.ndarray) -> bool:
    """Whether the middle of a part is inside the walls of a box, and not far above it; its extent (3,) is in m."""
    return bool(np.all(np.abs(in_box.position[:2]) < extent[:2] / 2) and abs(in_box.position[2]) < extent[2])
