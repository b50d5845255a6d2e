"""Whatever breaks in whichever primitive: no push, a stiff hold, everything at rest, and the reason in the trace."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from safety.faults import CLASSES, KINDS, reasons, run, scene_for, things, wanted, watched
from simulation.cells import ARM
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import COMPLIANT_CONTROLLER

SCOPED = ("OverlayCircle", "Push", "ReleaseAxis")
PHASES = ("start", "tick", "halt")
BY_SPEED = "ur5e_whiteboard"
"""The scene whose arm takes speeds, too."""


def _breaks() -> Iterator[object]:
    """Yield every primitive with every phase; in turns one phase is that of each change, the others belong to soak."""
    for number, name in enumerate(sorted(CLASSES)):
        phases = (*PHASES, "release") if name in SCOPED else PHASES
        for place, phase in enumerate(phases):
            marks = () if place == number % len(phases) else (pytest.mark.sim, pytest.mark.long)
            yield pytest.param(name, phase, marks=marks)


def is_safe(there: SimulatedCell, scene: str) -> None:
    """The arm comes to rest within two seconds, exerts nothing, and is held stiff where it is."""
    arm = there.arm(things(scene)["arm"])
    for _ in range(200):
        if there.is_at_rest():
            break
        there.advance(0.01)
    assert there.is_at_rest()
    assert not arm.compliance.commanded_wrench.any()
    assert arm.compliance.commanded_stiffness.all()
    there.advance(0.3)
    before = arm.measured.pose.position
    there.advance(0.05)
    assert np.abs(arm.measured.pose.position - before).max() < 3e-4
    assert np.linalg.norm(arm.measured.wrench[:3]) < 3.0


@pytest.mark.slow
@pytest.mark.parametrize(("name", "phase"), list(_breaks()))
def test_a_primitive_that_breaks_leaves_a_stiff_hold(name: str, phase: str) -> None:
    scene = scene_for(CLASSES[name], sorted(CLASSES).index(name) % 2)
    there = SimulatedCell(WorldModel(watched(scene)))
    told, status = run(there, scene, name, phase)
    assert f"broke at {phase}" in reasons(told)
    assert status == ("failed" if phase in ("start", "tick") else "stopped")
    is_safe(there, scene)


def _of_arms() -> Iterator[object]:
    """Yield the primitives that move an arm or change how it yields, with a phase each; all but two belong to soak."""
    known = set(things(BY_SPEED))
    needs = {name: wanted(cls) for name, cls in sorted(CLASSES.items())}
    arms = [name for name, needed in needs.items() if "arm" in needed and needed & set(KINDS) <= known]
    for number, name in enumerate(arms):
        marks = () if name in ("MoveLinear", "Push") else (pytest.mark.sim, pytest.mark.long)
        yield pytest.param(name, PHASES[number % 3], marks=marks)


@pytest.mark.parametrize(("name", "phase"), list(_of_arms()))
def test_an_arm_that_takes_speeds_is_left_with_a_stiff_hold_as_well(name: str, phase: str) -> None:
    by_speed = SetProperty(ARM[BY_SPEED], COMPLIANT_CONTROLLER, "forward_dynamics_velocity")
    there = SimulatedCell(WorldModel(watched(BY_SPEED).with_changes([by_speed])))
    told, status = run(there, BY_SPEED, name, phase)
    assert there.arms[ARM[BY_SPEED]].interface == "velocity"
    assert f"broke at {phase}" in reasons(told)
    assert status == ("stopped" if phase == "halt" else "failed")
    is_safe(there, BY_SPEED)


def test_all_primitives_of_the_package_are_here() -> None:
    assert {"MoveJoints", "MoveLinear", "FollowPath", "Push", "ReleaseAxis", "Align", "Grasp", "DriveBase"} <= set(
        CLASSES
    )
