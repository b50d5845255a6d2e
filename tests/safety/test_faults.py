"""Whatever breaks in whichever primitive: no push, a stiff hold, everything at rest, and the reason in the trace."""

from __future__ import annotations

import numpy as np
import pytest

from safety.faults import CLASSES, reasons, run
from simulation.cells import ARM, cell
from skillc_runtime.simulation.cell import SimulatedCell

SCENES = {name: ("iiwa_table", "ur5e_whiteboard")[number % 2] for number, name in enumerate(sorted(CLASSES))}
SCENES["DriveBase"] = "ur5e_whiteboard"
SCOPED = ("OverlayCircle", "Push", "ReleaseAxis")


def is_safe(there: SimulatedCell, scene: str) -> None:
    arm = there.arm(ARM[scene])
    assert there.at_rest
    assert not arm.commanded_wrench.any()
    assert arm.commanded_stiffness.all()
    before = arm.pose.position
    there.advance(0.05)
    assert np.abs(arm.pose.position - before).max() < 2e-4


@pytest.mark.parametrize("name", sorted(CLASSES))
def test_a_primitive_that_breaks_leaves_a_stiff_hold(name: str) -> None:
    scene = SCENES[name]
    there = cell(scene)
    phases = ("start", "tick", "halt", "release") if name in SCOPED else ("start", "tick", "halt")
    for phase in phases:
        told, status = run(there, scene, name, phase)
        assert f"broke at {phase}" in reasons(told), (phase, reasons(told))
        assert status == ("failure" if phase in ("start", "tick") else "halted")
        is_safe(there, scene)


def test_all_primitives_of_the_package_are_here() -> None:
    assert {"MoveJoints", "MoveLinear", "FollowPath", "Push", "ReleaseAxis", "Align", "Grasp", "DriveBase"} <= set(
        CLASSES
    )
