"""What a thing contains and what rests on it goes along with it, to any depth; nothing else does."""

from __future__ import annotations

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from backends.kinematic_runs import prepare
from bodies.test_trays import FOLDER, PART, TRAY, library
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.truth.claims import find_false_claims
from skillc_runtime.evaluation.report.handlings import measure_placements
from skillc_runtime.evaluation.report.table import format_placement
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.cargo import cargo_changes, find_cargo
from skillc_runtime.world.space.frames import place_changes, pose, relocation_changes
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAIN, FURNITURE
from space.rooms import at, lab, poses, same, thing, world

HEIGHT_M = 0.02


@settings(deadline=None, max_examples=40)
@given(st.data())
def test_what_is_above_or_inside_goes_along_and_nothing_else(data: st.DataObject) -> None:
    """Smaller plates lie on plates, at most three on each, some of which say that they contain what lies on them."""
    below = [data.draw(st.integers(-1, number - 1)) for number in range(data.draw(st.integers(2, 7)))]
    contained = data.draw(st.sets(st.integers(0, len(below) - 1)))
    places: list[Pose] = []
    sides: list[float] = []
    changes = thing("Table", at(0, 0, 0), size=(60, 60, 0.1), cls=FURNITURE)
    for number, lower in enumerate(below):
        beside = below[:number].count(lower) % 3 - 1
        on = at(4.0 * number, 0, -HEIGHT_M / 2) if lower < 0 else places[lower]
        places.append(on @ at(0.0 if lower < 0 else beside * sides[lower] / 3, 0, HEIGHT_M))
        sides.append(2.0 if lower < 0 else sides[lower] / 4)
        assume(below[:number].count(lower) < 3 or lower < 0)
        changes += thing(f"P{number}", places[-1], size=(sides[-1], sides[-1], HEIGHT_M))
        if lower in contained:
            changes.append(AddRelation(lab(f"P{lower}"), CONTAIN, lab(f"P{number}")))
    state, moved = world(changes), data.draw(st.integers(0, len(below) - 1))
    carried = {moved}
    for number, lower in enumerate(below):
        carried |= {number} if lower in carried else set()
    assert {each for each, _ in find_cargo(state, lab(f"P{moved}"))} == {lab(f"P{each}") for each in carried - {moved}}
    attached = state.with_changes(cargo_changes(state, lab(f"P{moved}")))
    goal = data.draw(poses)
    after = attached.with_changes(place_changes(attached, lab(f"P{moved}"), goal))
    for number, place in enumerate(places):
        assert same(pose(attached, lab(f"P{number}")), place), "nothing moves by being attached"
        expected = goal @ places[moved].inverse() @ place if number in carried else place
        assert same(pose(after, lab(f"P{number}")), expected)


@pytest.mark.slow
@pytest.mark.parametrize("backend", [pytest.param(SimulatedCell, marks=pytest.mark.sim), KinematicCell])
def test_a_part_whose_pose_is_stated_in_the_world_is_carried_in_its_tray(
    backend: type[SimulatedCell | KinematicCell],
) -> None:
    bare = prepare(library(), "carry", FOLDER / "cell.ttl").assignment.state
    there = pose(bare, TRAY) @ Pose.of((0.03, 0.0, -0.025 + 0.001 + 0.015))
    inside = [*relocation_changes(bare, PART, there), AddRelation(TRAY, CONTAIN, PART)]
    prepared = prepare(library(), "carry", FOLDER / "cell.ttl", inside)
    cell = backend(WorldModel(prepared.assignment.state))
    execution = execute_task(prepared, library(), cell)
    assert execution.status == "succeeded", execution.failure
    cell.advance(0.5)
    state = cell.world.snapshot()
    assert find_false_claims(cell.scene.bodies, state, cell.ground_truth) == ()
    moved = pose(state, PART).position - there.position
    assert moved == pytest.approx(pose(state, TRAY).position - pose(bare, TRAY).position, abs=0.002)
    shown = {str(each.thing): format_placement(each) for each in measure_placements(cell.world, cell.ground_truth)}
    assert "moved with lab:Tray-1" in shown["lab:Part-A"]
