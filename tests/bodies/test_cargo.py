"""A driving base takes along what stands on it, as far as friction and mass let it; nothing else."""

from __future__ import annotations

import numpy as np
import pytest

from simulation.cells import world as scene
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import Change, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAINER, FURNITURE
from space.rooms import PART, at, lab, skillc, thing

HERON = lab("Heron-1")
TRAY = thing("Tray", at(-0.15, 0.0, 0.63), frame="heron", size=(0.3, 0.3, 0.06), cls=CONTAINER)


def cube(name: str, place: Pose, frame: str = "heron") -> list[Change]:
    return thing(name, place, frame=frame, size=(0.04, 0.04, 0.04), cls=PART)


@pytest.mark.slow
@pytest.mark.parametrize("backend", [SimulatedCell, KinematicCell])
def test_what_stands_on_a_base_drives_with_it(backend: type[SimulatedCell | KinematicCell]) -> None:
    state = scene("ur5e_whiteboard").with_changes(
        [
            *TRAY,
            *cube("InTray", at(-0.15, 0.05, 0.624)),
            *cube("OnThat", at(-0.15, 0.05, 0.664)),
            *cube("OnBase", at(-0.32, -0.22, 0.62)),
            *cube("Beside", at(-0.15, 0.5, 0.02)),
        ]
    )
    cell = backend(WorldModel(state))
    cell.advance(0.2)
    truth, start = cell.ground_truth, cell.base(HERON).pose
    before = {name: truth.body_pose(lab(name)) for name in ("Tray", "InTray", "OnThat", "OnBase", "Beside")}
    cell.base(HERON).drive_to(pose(state, lab("Store")))
    while not cell.base(HERON).done:
        cell.advance(0.1)
    cell.advance(0.5)
    motion = cell.base(HERON).pose @ start.inverse()
    assert np.linalg.norm(motion.position) > 0.5
    for name, was in before.items():
        expected = was if name == "Beside" else motion @ was
        found = truth.body_pose(lab(name))
        np.testing.assert_allclose(found.position, expected.position, atol=0.002, err_msg=name)
        np.testing.assert_allclose(found.rotation, expected.rotation, atol=0.02, err_msg=name)


def drive(*changes: list[Change], goal: Pose) -> tuple[SimulatedCell, Pose]:
    """Return a cell after its base has driven to a pose with things on it, and how it has moved."""
    state = scene("ur5e_whiteboard").with_changes([change for each in changes for change in each])
    cell = SimulatedCell(WorldModel(state))
    cell.advance(0.2)
    start = cell.base(HERON).pose
    cell.base(HERON).drive_to(start @ goal)
    while not cell.base(HERON).done:
        cell.advance(0.1)
    cell.advance(1.0)
    return cell, cell.base(HERON).pose @ start.inverse()


def slip_m(cell: SimulatedCell, motion: Pose, name: str, before: Pose) -> float:
    """Return how far a thing is from where it would be, had it stayed where it was on the base."""
    mounted = pose(cell.world.snapshot(), HERON) @ before
    return float(np.linalg.norm((cell.ground_truth.body_pose(lab(name)).position - (motion @ mounted).position)[:2]))


@pytest.mark.parametrize(("friction", "slipped"), [(0.02, 0.103), (0.04, 0.0175), (0.1, 0.0)])
def test_a_thing_slips_on_a_base_as_coulomb_says(friction: float, slipped: float) -> None:
    """Expected is the solution of dv/dt = -a - mu g sign(v) for a drive of 0.4 m with a = 0.6 m/s^2 up and down."""
    place = at(0.1, 0.0, 0.62)
    plate = [*cube("Plate", place), SetProperty(lab("Plate"), skillc("friction"), friction)]
    cell, motion = drive(plate, goal=at(0.4, 0.0, 0.0))
    assert slip_m(cell, motion, "Plate", place) == pytest.approx(slipped, abs=0.002)


@pytest.mark.parametrize(("height", "falls"), [(0.04, False), (0.6, True)])
def test_what_is_tall_and_thin_tips_over_when_a_base_starts(height: float, falls: bool) -> None:
    place = at(-0.25, 0.0, 0.6 + height / 2)
    post = thing("Post", place, frame="heron", size=(0.02, 0.02, height), cls=PART)
    cell, _ = drive(post, goal=at(0.5, 0.0, 0.0))
    assert (cell.ground_truth.body_pose(lab("Post")).rotation[2, 2] < 0.9) == falls


def test_what_falls_off_a_base_stays_behind_and_does_not_follow_it_later() -> None:
    ball = [
        *thing("Ball", at(-0.25, 0.0, 0.62), frame="heron", size=(0.04, 0.04, 0.04), cls=PART),
        SetProperty(lab("Ball"), skillc("shape"), "sphere"),
    ]
    cell, motion = drive(ball, goal=at(1.5, 0.0, 0.0))
    truth, base = cell.ground_truth, cell.base(HERON)
    fallen = truth.body_pose(lab("Ball")).position
    assert fallen[2] == pytest.approx(0.02, abs=0.005)
    base.drive_to(base.pose @ at(0.3, 0.0, 0.0))
    cell.advance(2.0)
    assert truth.body_pose(lab("Ball")).position == pytest.approx(fallen, abs=0.1)
    assert base.done
    assert np.linalg.norm(motion.position) == pytest.approx(1.5, abs=0.01)


def test_what_lies_on_a_base_that_stops_at_once_slides_on() -> None:
    wall = thing("Wall", at(1.2, 0.0, 0.2), size=(0.1, 1.0, 0.2), cls=FURNITURE)
    place = at(-0.25, 0.0, 0.62)
    plate = [*cube("Plate", place), SetProperty(lab("Plate"), skillc("friction"), 0.3)]
    state = scene("ur5e_whiteboard").with_changes([*wall, *plate])
    cell = SimulatedCell(WorldModel(state))
    start = cell.base(HERON).pose
    cell.base(HERON).drive_to(start @ at(1.5, 0.0, 0.0))
    while not cell.base(HERON).at_rest:
        cell.advance(0.05)
    cell.advance(0.5)
    assert cell.base(HERON).fault is not None
    slip = slip_m(cell, cell.base(HERON).pose @ start.inverse(), "Plate", place)
    assert slip > 0.02, "v^2 / (2 mu g), at the speed at which it met the wall"
