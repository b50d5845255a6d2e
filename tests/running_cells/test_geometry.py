"""The geometry of a cell for displays: a sample then tells where all bodies are, coverage where tools have worked."""

from __future__ import annotations

from pathlib import Path

import msgspec
import numpy as np

from running_cells.kinematics import FILE, KinematicsCase, make_cases
from running_cells.test_condition import run_until
from running_cells.test_reality import BOARD, SORTING, TABLE, make_settings, reality
from skillc.cells.opening import open_cell
from skillc.contract.geometry import CellModel, SurfaceCoverage
from skillc.contract.operation import OperationRequest
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.devices.disturbances import MoveThing

BOARD_IRI, TABLE_IRI = "http://example.org/lab#Whiteboard-1", "http://example.org/lab#Table-1"
ARM, PART = "http://example.org/lab#Arm-1", "http://example.org/lab#Part-A"


def rounded(value: object) -> object:
    """Return a value as JSON has it, with numbers that do not depend on the processor's last digits."""
    match msgspec.to_builtins(value):
        case float(number):
            return round(number, 9) + 0.0
        case dict(parts):
            return {name: rounded(each) for name, each in parts.items()}
        case list(parts) | tuple(parts):
            return [rounded(each) for each in parts]
        case other:
            return other


def test_the_page_is_tested_with_the_poses_that_mujoco_computes() -> None:
    kept = msgspec.json.decode(FILE.read_bytes(), type=tuple[KinematicsCase, ...])
    made = make_cases()
    assert [rounded(each.model) for each in kept] == [rounded(each.model) for each in made], (
        "run `python tests/accept.py`"
    )
    for case, again in zip(kept, made, strict=True):
        assert np.allclose(case.poses, again.poses, rtol=0.0, atol=1e-9)


def test_the_geometry_names_what_is_in_the_cell(tmp_path: Path) -> None:
    with open_cell(make_settings(tmp_path, SORTING, "kinematic"), SilentReporter()) as host:
        model = msgspec.msgpack.decode(host.devices.geometry.take_model(), type=CellModel)
        part, arm = model.individuals[PART], model.individuals[ARM]
        assert (part.label, part.kind, part.movable) == ("lab:Part-A", "body", True)
        assert (arm.kind, arm.movable, len(model.arms[ARM].joints)) == ("arm", False, 7)
        assert model.bodies[arm.body].individual == ARM and model.bodies[0].individual is None
        shown = {each.individual for each in model.bodies if each.geoms}
        assert shown - {None} == set(model.individuals), "everything that has a body is drawn"
        assert all(each.parent < number for number, each in enumerate(model.bodies)), "parents come first"
        shell = model.bodies[arm.body].geoms[0].colour
        assert np.allclose(shell, (0.94, 0.94, 0.95, 1.0)), "that of its material"


def test_a_true_surface_stands_where_it_really_is(tmp_path: Path) -> None:
    with open_cell(make_settings(tmp_path, BOARD, "mujoco"), SilentReporter()) as host:
        model = msgspec.msgpack.decode(host.devices.geometry.take_model(), type=CellModel)
        true = reality(host).ground_truth.surface_pose(BOARD_IRI)
        assert np.allclose(model.bodies[model.individuals[BOARD_IRI].body].pose[:3], true.position)


def test_samples_follow_fingers_and_what_is_moved(tmp_path: Path) -> None:
    with open_cell(make_settings(tmp_path, SORTING, "kinematic"), SilentReporter()) as host:
        before = host.devices.sampler.take()
        host.disturb(MoveThing(PART, (0.1, 0.0, 0.0)), "somebody")
        host.submit("first", OperationRequest(task=SORTING[1]))
        assert np.isclose(host.devices.sampler.take().things[PART][0] - before.things[PART][0], 0.1)
        run_until(host, 600)
        after = host.devices.sampler.take()
        assert set(before.joints) == {"lab:Hand-1/left_finger", "lab:Hand-1/right_finger"}
        assert after.joints != before.joints, "the hand has opened"


def test_coverage_and_forces_are_those_of_a_tool_that_works(tmp_path: Path) -> None:
    with open_cell(make_settings(tmp_path, TABLE, "mujoco"), SilentReporter()) as host:
        before = msgspec.msgpack.decode(host.devices.geometry.take_coverage(), type=dict[str, SurfaceCoverage])
        assert before[TABLE_IRI].dose == b""
        host.submit("first", OperationRequest(task=TABLE[1]))
        truth = reality(host).ground_truth
        while truth.coverage(TABLE_IRI).wiped_share < 0.01:
            host.tick()
            assert "first" in host._operations, "it has ended before it has wiped anything"
        sample = host.devices.sampler.take()
        after = msgspec.msgpack.decode(host.devices.geometry.take_coverage(), type=dict[str, SurfaceCoverage])[
            TABLE_IRI
        ]
        dose = np.frombuffer(after.dose, np.uint8).reshape(after.rows, after.columns)
        assert np.array_equal(dose > 0, truth.coverage(TABLE_IRI).dose > 0)
        assert np.allclose(after.size, reality(host).scene.surfaces[0].size[:2])
        ((tool, pressed),) = sample.forces.items()
        assert np.allclose(pressed.point, truth.face_position(tool), atol=0.005)
        assert pressed.force[2] > 0.5, "the table pushes the tool up"
