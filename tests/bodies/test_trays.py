"""A tray that is carried takes along what lies in it, in truth and in the world model; what is slippery slides off."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from backends.kinematic_runs import prepare
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.truth.claims import find_false_claims
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.world.space.frames import pose, put_down_changes
from skillc_runtime.world.state.changes import AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAIN, FRICTION, OFFSET, ON, SHAPE
from space.rooms import at, lab, same, thing, world

FOLDER = Path(__file__).parent / "trays"
PART, TRAY, SHELF = lab("Part-A"), lab("Tray-1"), lab("Shelf-1")


@cache
def library() -> SkillLibrary:
    return compile_valid(find_library(FOLDER))


def run_task(task: str, backend: type[SimulatedCell | KinematicCell], *changes: Change) -> tuple[str, ...]:
    """Run a task and return what the world model claims falsely; the tray is on the shelf in truth."""
    prepared = prepare(library(), task, FOLDER / "cell.ttl", changes)
    cell = backend(WorldModel(prepared.assignment.state))
    execution = execute_task(prepared, library(), cell)
    assert execution.status == "succeeded", execution.failure
    cell.advance(0.5)
    truth, state = cell.ground_truth, cell.world.snapshot()
    apart = truth.body_pose(TRAY).position[:2] - pose(state, SHELF).position[:2]
    assert np.abs(apart).max() < 0.05
    return find_false_claims(cell.scene.bodies, state, truth)


@pytest.mark.slow
@pytest.mark.parametrize("backend", [pytest.param(SimulatedCell, marks=pytest.mark.sim), KinematicCell])
def test_a_part_is_put_into_a_tray_and_carried_with_it(backend: type[SimulatedCell | KinematicCell]) -> None:
    assert run_task("serve", backend) == ()


@pytest.mark.sim
@pytest.mark.parametrize(("friction", "stays"), [(0.5, True), (0.02, False)])
def test_what_slides_off_a_board_that_is_carried_is_a_false_claim(friction: float, stays: bool) -> None:
    on_board: list[Change] = [
        SetProperty(TRAY, SHAPE, "box"),
        *(RemoveRelation(PART, ON, lab("Table")), AddRelation(PART, ON, TRAY)),
        *(RemoveRelation(lab("Cell"), CONTAIN, PART), AddRelation(TRAY, CONTAIN, PART)),
        *(SetProperty(PART, name, value) for name, value in zip(OFFSET, (0.06, 0.0, 0.0), strict=True)),
        SetProperty(PART, FRICTION, friction),
        SetProperty(TRAY, FRICTION, friction),
    ]
    false = run_task("carry", SimulatedCell, *on_board)
    assert (false == ()) == stays, false
    assert all("lab:Part-A" in each for each in false)


def test_what_is_put_into_a_thing_that_moves_moves_with_it_and_else_it_stays_where_it_is() -> None:
    for cls, moves in (("http://rvmi.aau.dk/ontologies/skiros.owl#Product", True), (None, False)):
        kind = {} if cls is None else {"cls": cls}
        tray = thing("Tray", at(1, 0, 0), size=(0.2, 0.2, 0.05), **({"cls": lab("Place")} if cls is None else kind))
        state = world(tray, thing("Part", at(0, 0, 1), size=(0.1, 0.1, 0.1)))
        after = state.with_changes(put_down_changes(state, lab("Part"), at(1, 0, 0.1), lab("Tray")))
        assert same(pose(after, lab("Part")), at(1, 0, 0.1))
        moved = after.with_changes(thing("Tray", at(2, 0, 0)))
        assert same(pose(moved, lab("Part")), at(2 if moves else 1, 0, 0.1))
