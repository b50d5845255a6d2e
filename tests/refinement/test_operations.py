"""Operations of a cell look at their plans in space from where its arms are measured."""

import shutil
from contextlib import closing
from pathlib import Path
from types import SimpleNamespace

import pytest
from msgspec import structs

from refinement.scenes import write_door
from skillc.cells.host import CellHost
from skillc.cells.journal.reading import JournalReader
from skillc.cells.opening import open_cell
from skillc.cells.settings import CellSettings
from skillc.cells.snapshot import decode_snapshot
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc.contract.plan import PlanRequest
from skillc.contract.rehearsal import RehearsalRequest
from skillc.server.jobs.kinds.plan import preview_plan
from skillc.server.jobs.kinds.rehearsal import rehearse
from skillc.services.reporting.reporter import SilentReporter
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


@pytest.mark.slow
def test_a_preview_looks_from_where_the_arms_are_as_the_operation_would(tmp_path: Path) -> None:
    with open_cell(settings_of(tmp_path, write_door(tmp_path, 0.5, -20.0, 0.75)), SilentReporter()) as host:
        known = decode_snapshot(host.take_snapshot(with_arms=True))
        found = preview_plan(PlanRequest(goal=GOAL), known)
        host.submit("same", OperationRequest(goal=GOAL, approve=True))
        planned = wait_for(host, "same", "planned")
    assert known.postures is not None and len(known.postures) == 1
    assert found.status == "solved" and found.space is not None
    assert (found.space.checked, found.space.from_home) == (2, False) and len(found.space.postures) == 2
    assert found.text.endswith(
        "all 2 checked in space: reach, joints, torques, paths, room; the arms begin where they are"
    )
    assert planned.state == "planned"


@pytest.mark.slow
def test_a_preview_says_why_the_arm_cannot_carry_it_out_unless_nobody_looks(tmp_path: Path) -> None:
    with open_cell(settings_of(tmp_path, write_door(tmp_path, 0.45, -20.0, 0.75)), SilentReporter()) as host:
        known = decode_snapshot(host.take_snapshot(with_arms=True))
    found = preview_plan(PlanRequest(goal=GOAL), known)
    assert found.status == "gave-up" and "joint 4 would be at -3." in found.failure
    unseen = preview_plan(PlanRequest(goal=GOAL, geometry=False), known)
    assert (unseen.status, unseen.space) == ("solved", None)


@pytest.mark.slow
def test_a_rehearsal_of_a_plan_that_was_previewed_does_not_look_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("skillc.services.space.run_looks.cache", SimpleNamespace(cache_folder=lambda: tmp_path))
    looks = tmp_path / "looks"
    with open_cell(settings_of(tmp_path, write_door(tmp_path, 0.5, -20.0, 0.75)), SilentReporter()) as host:
        known = decode_snapshot(host.take_snapshot(with_arms=True))
        twin = decode_snapshot(host.take_twin())
    preview_plan(PlanRequest(goal=GOAL), known)
    (found,) = looks.rglob("*")
    kept = found.stat()
    rehearsed = rehearse(RehearsalRequest(goal=GOAL), tmp_path / "out", twin)
    assert rehearsed.status == "succeeded"
    assert list(looks.rglob("*")) == [found] and found.stat().st_mtime_ns == kept.st_mtime_ns


@pytest.mark.slow
def test_what_goes_on_after_an_interruption_takes_the_postures_of_its_plan(tmp_path: Path) -> None:
    """Not all lanes of the door go from the posture nearest to home."""
    settings = settings_of(tmp_path / "cell", write_door(tmp_path, 0.5, -20.0, 0.75))
    with open_cell(settings, SilentReporter()) as host:
        host.submit("first", OperationRequest(goal=GOAL))
        wait_for(host, "first", "running")
        for _ in range(200):
            host.tick()
        shutil.copytree(tmp_path / "cell", tmp_path / "image")
    again = structs.replace(settings, folder=str(tmp_path / "image"))
    with open_cell(again, SilentReporter()) as host, closing(JournalReader(again.journal)) as journal:
        host.submit("second", OperationRequest(continues="first", decision="retry"))
        ended = wait_for(host, "second", *ENDS)
        events = [each.event for each in journal.envelopes("second", 0)]
    assert ended.state == "succeeded", ended.reason
    (plan,) = [each for each in events if isinstance(each, PlanMade)]
    assert plan.space is not None and plan.space.postures
    assert plan.space.summary == "not checked in space: it goes on after an interruption"
