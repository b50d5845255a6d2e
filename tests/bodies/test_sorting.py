"""Parts and bins that only facts describe are picked, carried and placed, and lie in the bins at the end, in truth."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from backends.kinematic_runs import prepare
from skillc.services.library import libraries
from skillc.services.library.files import find_library
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAIN, END_EFFECTOR

LAB = "http://example.org/lab#"
FOLDER = Path(__file__).parent / "sorting"


@pytest.mark.slow
@pytest.mark.parametrize("backend", [pytest.param(SimulatedCell, marks=pytest.mark.sim), KinematicCell])
def test_parts_are_sorted_into_bins(backend: type[SimulatedCell | KinematicCell]) -> None:
    outcome = libraries.compile_library(find_library(FOLDER))
    assert outcome.ok, outcome.diagnostics
    prepared = prepare(outcome.value, "sort_parts", FOLDER / "cell.ttl")
    cell = backend(WorldModel(prepared.assignment.state))
    execution = execute_task(prepared, outcome.value, cell)
    assert execution.status == "succeeded", execution.failure
    cell.advance(0.5)
    for letter in "AB":
        part, bin_ = LAB + f"Part-{letter}", LAB + f"Bin-{letter}"
        in_bin = cell.ground_truth.body_pose(bin_).inverse() @ cell.ground_truth.body_pose(part)
        assert np.abs(in_bin.position[:2]).max() < 0.01
        height = {"A": 0.06, "B": 0.07}[letter]
        assert in_bin.position[2] == pytest.approx(-0.03 + 0.004 + height / 2, abs=0.003)
        assert cell.world.snapshot().holds(bin_, CONTAIN, part)


@pytest.mark.sim
def test_the_force_of_a_hand_is_that_of_its_present_contacts() -> None:
    outcome = libraries.compile_library(find_library(FOLDER))
    prepared = prepare(outcome.value, "sort_parts", FOLDER / "cell.ttl")
    cell = SimulatedCell(WorldModel(prepared.assignment.state))
    (gripper,) = prepared.assignment.state.instances(END_EFFECTOR)
    forces = list[float]()

    def look() -> None:
        force = cell.ground_truth.contact_force(gripper)
        assert force is not None
        forces.append(float(np.linalg.norm(force)))

    def touches() -> bool:
        return sum(force > 1.0 for force in forces) > 5

    assert execute_task(prepared, outcome.value, cell, after_tick=look, interrupted=touches).status == "stopped"
    cell.advance(0.5)
    look()
    assert touches() and max(forces) < 40.0, "no push of this task is stronger, also when contacts begin or end"
