"""The result of a run says where things ended up, how that is known, and how far from there they really are."""

from __future__ import annotations

from pathlib import Path

import pytest

from backends.kinematic_runs import library, prepare
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_ontology import catalogue
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.evaluation.report.handlings import measure_placements
from skillc_runtime.evaluation.report.table import format_placement
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.world.state.model import WorldModel

FOLDER = Path(__file__).parent / "sorting"


@pytest.mark.slow
def test_each_thing_that_was_moved_is_listed_with_its_true_place() -> None:
    compiled = compile_valid(find_library(FOLDER))
    prepared = prepare(compiled, "sort_parts", FOLDER / "cell.ttl")
    cell = KinematicCell(WorldModel(prepared.assignment.state))
    assert measure_placements(cell.world, cell.ground_truth) == ()
    assert execute_task(prepared, compiled, cell).status == "succeeded"
    one, other = measure_placements(cell.world, cell.ground_truth)
    assert (str(one.thing), str(one.holder), one.known, one.is_held) == (
        "lab:Part-A",
        "lab:Bin-A",
        "assumed by Release",
        False,
    )
    assert (str(other.thing), str(other.holder)) == ("lab:Part-B", "lab:Bin-B")
    assert one.believed_m == pytest.approx((0.45, 0.15, 0.636), abs=5e-3)
    assert one.error_m is not None and one.error_m < 5e-3

    first = int(cell.model.joint("lab:Part-A/free").qposadr[0])
    cell.data.qpos[first : first + 2] += (0.3, -0.4)
    cell.advance(0.1)
    thrown, kept = measure_placements(cell.world, cell.ground_truth)
    assert thrown.error_m == pytest.approx(0.5, abs=5e-3) and thrown.believed_m == one.believed_m
    assert "in lab:Bin-A, at 0.450 0.150 0.6" in format_placement(thrown)
    assert format_placement(thrown).endswith("m, assumed by Release; really 500 mm and 0 deg from there")
    assert kept == other


@pytest.mark.slow
def test_a_held_thing_is_where_the_hand_is() -> None:
    compiled = library("wiping")
    prepared = prepare(compiled, "clean_table", catalogue.scene_path("iiwa_table"))
    cell = KinematicCell(WorldModel(prepared.assignment.state))
    execute_task(prepared, compiled, cell)
    (eraser,) = measure_placements(cell.world, cell.ground_truth)
    assert eraser.is_held and eraser.believed_m is None and eraser.error_m is None
    assert format_placement(eraser) == "held by lab:Robotiq-1, idealised by Grasp"
