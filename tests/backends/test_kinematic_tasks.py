"""Every shipped task ends in success in a cell without physics, and is verified only as far as kinematics can."""

from __future__ import annotations

from pathlib import Path

import pytest

from backends.kinematic_runs import library, run_shipped, run_task, shipped_tasks
from simulation.cells import GRIPPER, LAB
from skillc.services.library import libraries
from skillc.services.library.files import find_library
from skillc_ontology import catalogue
from skillc_runtime.recording.known_facts import format_unverified, unverified_facts

WIPING = ("clean", "share", "polish")
"""How the names of the tasks begin that wipe or polish, which takes some seconds; they belong to the simulations."""
CHOSEN = ("clean_desk", "polish_sheet")
"""Those of them that are run for each change; the others have `sim.test_two_robots`, `sim.test_holes` and pages."""


def _marks(name: str) -> tuple[pytest.MarkDecorator, ...]:
    if not name.startswith(WIPING):
        return ()
    return (pytest.mark.sim,) if name in CHOSEN else (pytest.mark.sim, pytest.mark.long)


TASKS = [pytest.param(name, marks=_marks(name)) for name in shipped_tasks()]


@pytest.mark.slow
@pytest.mark.parametrize("name", TASKS)
def test_a_shipped_task_succeeds_and_is_not_called_verified(name: str) -> None:
    execution, result = run_shipped(name)
    assert execution.status == "succeeded", execution.failure
    assert execution.verified is False
    assert len(execution.attempts) == 1
    assert execution.backend.is_at_rest()
    assert execution.backend.secure() == ()
    for wiping in result.wipings:
        assert wiping.coverage >= 0.99
        assert abs(wiping.force_mean_n / wiping.force_command_n - 1) <= 0.1
        assert wiping.contact_lost <= 0.01
    assert bool(result.wipings) == name.startswith(WIPING)


def test_what_is_not_verified_is_said_with_the_reason() -> None:
    execution, _ = run_shipped("press_button")
    assert list(map(format_unverified, unverified_facts(execution.facts))) == [
        "lab:Button-1.isOn == true is only idealised: AwaitSwitch measured it without physics; "
        "a cell with physics would have to confirm it",
        "lab:Ur5e-1.pushForce == 10 N is only idealised: Push measured it without physics; "
        "a cell with physics would have to confirm it",
    ]


def test_a_task_that_rests_on_where_a_base_is_is_verified(tmp_path: Path) -> None:
    (tmp_path / "go.skill").write_text(
        'prefix lab: <http://example.org/lab#>\nuse skiros\nimport "driving.skill"\n\n'
        'task go_to_store {\n    scene "ur5e_whiteboard"\n    goal lab:Heron-1 at lab:Store\n}\n',
        encoding="utf-8",
    )
    outcome = libraries.compile_library(find_library(tmp_path))
    assert outcome.ok, outcome.diagnostics
    execution, _ = run_task(outcome.value, "go_to_store", catalogue.scene_path("ur5e_whiteboard"))
    assert execution.status == "succeeded", execution.failure
    assert [fact.known for fact in execution.facts] == ["reported"]
    assert execution.verified


def test_the_same_task_gives_the_same_run_bit_for_bit() -> None:
    compiled, ends = library("contact"), []
    for _ in range(2):
        execution, _ = run_task(compiled, "press_button", catalogue.scene_path("ur5e_button"))
        ends.append((execution.backend.now, execution.backend.data.qpos.tobytes()))
    assert ends[0] == ends[1]


def test_a_grasp_and_a_release_are_not_verified_by_ideal_fingers() -> None:
    execution, _ = run_shipped("insert_peg")
    world = execution.backend.world
    evidence = {
        each.evidence
        for each in (write.decides for write in world.ledger.writes)
        if each.origin in ("Grasp", "Release")
    }
    assert GRIPPER["panda_desk"] == LAB + "Hand-1"
    assert evidence == {"idealised", "assumed"}
