"""Whatever breaks in whichever primitive: no push, a stiff hold, everything at rest, and the reason in the trace."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from safety.faults import CLASSES, reasons, run, scene_for, things
from simulation.cells import cell
from skillc_runtime.simulation.cell import SimulatedCell

SCOPED = ("OverlayCircle", "Push", "ReleaseAxis")
PHASES = ("start", "tick", "halt")


def _breaks() -> Iterator[object]:
    """Yield every primitive with every phase; in turns one phase is fast, the others belong to the simulations."""
    for number, name in enumerate(sorted(CLASSES)):
        phases = (*PHASES, "release") if name in SCOPED else PHASES
        for place, phase in enumerate(phases):
            fast = place == number % len(phases)
            yield pytest.param(name, phase, marks=() if fast else pytest.mark.sim)


def is_safe(there: SimulatedCell, scene: str) -> None:
    """The arm comes to rest within two seconds, exerts nothing, and is held stiff where it is."""
    arm = there.arm(things(scene)["arm"])
    for _ in range(200):
        if there.at_rest:
            break
        there.advance(0.01)
    assert there.at_rest
    assert not arm.commanded_wrench.any()
    assert arm.commanded_stiffness.all()
    there.advance(0.3)
    before = arm.pose.position
    there.advance(0.05)
    assert np.abs(arm.pose.position - before).max() < 3e-4
    assert np.linalg.norm(arm.wrench[:3]) < 3.0


@pytest.mark.parametrize(("name", "phase"), list(_breaks()))
def test_a_primitive_that_breaks_leaves_a_stiff_hold(name: str, phase: str) -> None:
    scene = scene_for(CLASSES[name], sorted(CLASSES).index(name) % 2)
    there = cell(scene)
    told, status = run(there, scene, name, phase)
    assert f"broke at {phase}" in reasons(told)
    assert status == ("failure" if phase in ("start", "tick") else "halted")
    is_safe(there, scene)


def test_all_primitives_of_the_package_are_here() -> None:
    assert {"MoveJoints", "MoveLinear", "FollowPath", "Push", "ReleaseAxis", "Align", "Grasp", "DriveBase"} <= set(
        CLASSES
    )
