"""The figures and the table of pick and place: from the events of a run, and from what the simulator has."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from backends.kinematic_runs import library, prepare
from skillc.services.library.files import SHIPPED
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.evaluation.report.figure import render_figure
from skillc_runtime.evaluation.report.handling_drawing import HandlingDrawing, make_handling_drawings
from skillc_runtime.evaluation.report.handling_figures import draw_grips, draw_path
from skillc_runtime.evaluation.report.handlings import Handling, find_handlings, find_targets, measure_placements
from skillc_runtime.evaluation.report.result import PlacementResult
from skillc_runtime.evaluation.report.run_trace import HAND_PERIOD_S, HandTrace
from skillc_runtime.evaluation.report.table import format_placement, split_placement
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import ANGLES, SIZE

LAB = "http://example.org/lab#"
PITCH = ANGLES[1]


@cache
def sorted_parts() -> tuple[tuple[Handling, ...], HandlingDrawing, tuple[PlacementResult, ...]]:
    """Sort a part that lies and one that stands, without physics, and push this by 0.1 m once it is in its box."""
    compiled = library("sorting")
    lies = [SetProperty(f"{LAB}Part-A", PITCH, 90.0), SetProperty(f"{LAB}Box-A", SIZE[1], 0.22)]
    prepared = prepare(compiled, "sort_parts", SHIPPED / "sorting" / "panda.ttl", lies)
    cell, told = KinematicCell(WorldModel(prepared.assignment.state)), HistoryBuilder()
    trace = HandTrace(cell)
    execution = execute_task(prepared, compiled, cell, [told], trace.sample)
    assert execution.status == "succeeded", execution.failure
    cell.data.qpos[int(cell.model.joint("lab:Part-B/free").qposadr[0])] += 0.1
    cell.advance(0.1)
    handlings = find_handlings(told.history, cell.world.snapshot())
    (drawing,) = make_handling_drawings(handlings, trace, cell.world.snapshot(), cell.ground_truth)
    return handlings, drawing, measure_placements(cell.world, cell.ground_truth, find_targets(handlings))


@pytest.mark.slow
def test_each_pick_is_found_with_its_times_and_where_the_part_was_to_go() -> None:
    (one, other), _, _ = sorted_parts()
    assert (one.thing, one.arm, one.gripper) == (f"{LAB}Part-A", f"{LAB}Arm-1", f"{LAB}Hand-1")
    assert one.released_s is not None and one.grasped_s < one.released_s < other.grasped_s
    assert one.target_m == pytest.approx((0.45, 0.15), abs=2e-3)
    assert other.target_m == pytest.approx((0.45, 0.36), abs=2e-3)


def test_a_part_that_lies_elsewhere_is_as_far_off_its_believed_place_as_off_where_it_should_be() -> None:
    _, _, (kept, pushed) = sorted_parts()
    assert kept.missed_m is not None and kept.missed_m < 5e-3
    assert pushed.missed_m == pytest.approx(0.1, abs=3e-3) and pushed.error_m == pytest.approx(0.1, abs=3e-3)
    assert format_placement(pushed).endswith("100 mm and 0 deg from there, 100 mm from where it should be")
    should_be, believed, known, really, off, missed = split_placement(pushed)
    assert should_be == "450 360" and believed.startswith("in lab:Box-B, 450 360") and really.startswith("550 360")
    assert (known, off, missed) == ("assumed by Release", "100.0 mm, 0.0 deg", "100.0 mm")


def test_the_drawing_has_the_parts_at_both_ends_and_the_pushed_one_where_it_is_believed() -> None:
    _, drawing, _ = sorted_parts()
    middles = {(each.name, each.role): each.points.mean(axis=0)[:2] for each in drawing.outlines}
    assert ("Box A", "place") in middles and ("Table", "scenery") in middles
    assert middles["Part A", "start"] == pytest.approx((0.45, -0.35), abs=1e-3)
    assert middles["Part A", "end"] == pytest.approx((0.45, 0.15), abs=5e-3)
    assert middles["Part B", "end"] == pytest.approx((0.55, 0.36), abs=5e-3)
    assert middles["Part B", "believed end"] == pytest.approx((0.45, 0.36), abs=5e-3)
    assert ("Part A", "believed end") not in middles


def test_the_hand_is_sampled_with_what_its_fingers_measure() -> None:
    (one, _), drawing, _ = sorted_parts()
    assert float(np.diff(drawing.path.time).min()) >= HAND_PERIOD_S - 1e-6
    assert one.released_s is not None
    held = drawing.picks[0].samples.between(one.grasped_s + HAND_PERIOD_S, one.released_s - 1.0)
    assert held.opening == pytest.approx(0.04, abs=1e-3)
    assert held.measured_opening == pytest.approx(held.opening)
    assert np.isnan(held.finger_force).all()


def test_the_figures_have_words_units_and_equal_scales_and_the_same_bytes_every_time() -> None:
    _, drawing, _ = sorted_parts()
    above, beside = draw_path(drawing).axes
    assert all(axes.get_aspect() == 1.0 for axes in (above, beside))
    assert (above.get_ylabel(), beside.get_ylabel()) == ("x in the world, mm", "z in the world, mm")
    words = {text.get_text() for text in above.texts}
    assert {"Part A", "Part B", "Box A", "Box B"} <= words and not any(":" in each for each in words)
    assert [panel.get_title() for panel in draw_grips(drawing).axes] == ["1  Part A", "2  Part B"]
    assert render_figure(lambda: draw_path(drawing)) == render_figure(lambda: draw_path(drawing))
