"""A driving base takes along what stands on it, in a bin on it, and on that; nothing else."""

from __future__ import annotations

import numpy as np
import pytest

from simulation.cells import world as scene
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAINER
from space.rooms import PART, at, lab, thing

HERON = lab("Heron-1")
TRAY = thing("Tray", at(-0.15, 0.0, 0.63), frame="heron", size=(0.3, 0.3, 0.06), cls=CONTAINER)


def cube(name: str, place: Pose, frame: str = "heron") -> list[Change]:
    return thing(name, place, frame=frame, size=(0.04, 0.04, 0.04), cls=PART)


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
