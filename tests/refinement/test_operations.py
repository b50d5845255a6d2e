"""Operations of a cell look at their plans in space from where its arms are measured."""

from contextlib import closing
from pathlib import Path

import pytest

from refinement.scenes import write_door
from skillc.cells.host import CellHost, open_cell
from skillc.cells.journal.reading import JournalReader
from skillc.cells.settings import CellSettings
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc.services.reporting import SilentReporter
from skillc_ontology import catalogue
from skillc_runtime.recording.events import PlanMade
from skillc_runtime.recording.states import ENDS

GOAL = "lab:Desk-1.isClean == true"


def settings_of(folder: Path, scene: Path) -> CellSettings:
    return CellSettings(name="cell", scene=str(scene), library="wiping", folder=str(folder), backend="kinematic")


def wait_for(host: CellHost, operation: str, *states: str) -> OperationStatus:
    """Tick until an operation is in one of these states."""
    while True:
        if not host.tick():
            host.loop.wait(0.05)
        for each in host.take_changed():
            if each.id == operation and each.state in states:
                return each


@pytest.mark.slow
def test_an_operation_that_the_arm_cannot_carry_out_fails_before_anything_moves(tmp_path: Path) -> None:
    door = write_door(tmp_path, 0.45, -20.0, 0.75)
    with open_cell(settings_of(tmp_path, door), SilentReporter()) as host:
        host.submit("looked-at", OperationRequest(goal=GOAL))
        ended = wait_for(host, "looked-at", *ENDS)
        assert ended.state == "failed" and host.loop.backend.clock.now == 0.0
        assert "joint 4 would be at -3." in ended.reason
        host.submit("not-looked-at", OperationRequest(goal=GOAL, geometry=False))
        wait_for(host, "not-looked-at", "running")
        host.stop("not-looked-at", "enough")
        assert wait_for(host, "not-looked-at", *ENDS).state == "stopped"


@pytest.mark.slow
def test_the_look_begins_where_the_arms_are(tmp_path: Path) -> None:
    settings = settings_of(tmp_path, catalogue.scene_path("panda_desk"))
    with open_cell(settings, SilentReporter()) as host, closing(JournalReader(settings.journal)) as journal:
        host.submit("first", OperationRequest(goal=GOAL))
        wait_for(host, "first", "running")
        host.tick()
        (plan,) = [each.event for each in journal.envelopes("first", 0) if isinstance(each.event, PlanMade)]
    assert plan.space is not None
    assert (plan.space.checked, plan.space.failure, plan.space.from_home) == (2, None, False)
    assert plan.space.text.endswith("the arms begin where they are")
