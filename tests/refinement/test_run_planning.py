"""What a run is planned with: a look that fails keeps nothing from running, and what was found once is kept."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from msgspec import structs
from msgspec.structs import replace

from skillc.services.planning.plan_cache import FolderPlanCache
from skillc.services.planning.planning import plan_goal, prepare_planners
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.tasks.loading import LoadedTask, load_task
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import NotStarted, PreparedTask
from skillc_runtime.execution.refinement import run_planning
from skillc_runtime.execution.refinement.look_memory import LookMemory
from skillc_runtime.execution.refinement.run_planning import SpaceLook
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.changes import ClearProperty, RemoveIndividual, SetProperty
from skillc_runtime.world.state.terms import ARM_DEVICE, CAMERA, SIZE

LAB = "http://example.org/lab#"


@contextmanager
def loaded(task: str) -> Iterator[LoadedTask]:
    with load_task(RunSpec(task=task), SilentReporter()) as found:
        yield found


def look_at(task: LoadedTask, look: SpaceLook, limit_s: float = 60.0) -> SpaceClaim:
    """Return what is known of the plan of a task in space."""
    cancel = CancelToken(limit_s)
    prepared = prepare_task(task.assignment, task.library, (), prepare_planners(True), cancel, look=look)
    assert isinstance(prepared, PreparedTask) and prepared.planned is not None
    assert prepared.space is not None
    return prepared.space


@pytest.mark.slow
def test_a_look_that_fails_keeps_nothing_from_running() -> None:
    with loaded("clean_table") as task:
        (arm,) = task.assignment.state.instances(ARM_DEVICE)
        claim = look_at(task, SpaceLook({arm: (0.0, 0.0)}))
    assert claim.summary.startswith("not checked in space: the look has failed: ValueError: ")
    assert (claim.checked, claim.from_home) == (0, False)


@pytest.mark.slow
def test_a_look_without_time_keeps_nothing_from_running(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run_planning, "LOOK_S", 0.0)
    with loaded("clean_table") as task:
        answer = plan_goal(task, prepare_planners(True), CancelToken(60.0))
        state, late = task.assignment.state, CancelToken(0.0)
        planned, claim = run_planning.plan_for_run(task.library, state, lambda without: answer, SpaceLook(), late)
    assert planned is answer and claim is not None
    assert claim.summary == "not checked in space: it ran out of time"


@pytest.mark.slow
def test_what_a_run_may_sense_is_no_reason_to_refuse_it() -> None:
    with loaded("sorting:sort_seen_parts") as task:
        unknown = [ClearProperty(f"{LAB}Box-{box}", each) for box in "AB" for each in SIZE]
        state = task.assignment.state.with_changes(unknown)
        claim = look_at(structs.replace(task, assignment=structs.replace(task.assignment, state=state)), SpaceLook())
    assert (claim.checked, claim.steps) == (1, 6)
    assert claim.failure is not None and "has no size" in claim.failure


@pytest.mark.slow
def test_without_a_camera_nothing_finds_room_that_is_not_known() -> None:
    with loaded("sorting:sort_parts") as task:
        state = task.assignment.state
        blind = [RemoveIndividual(each) for each in state.instances(CAMERA)]
        state = state.with_changes([*blind, *(SetProperty(f"{LAB}Box-{box}", SIZE[0], 0.03) for box in "AB")])
        assignment = structs.replace(task.assignment, state=state)
        prepared = prepare_task(
            assignment, task.library, (), prepare_planners(True), CancelToken(60.0), look=SpaceLook()
        )
    assert isinstance(prepared, NotStarted) and "do not fit into" in str(prepared)


@pytest.mark.slow
def test_what_was_found_is_kept_for_the_same_facts_and_postures(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = list[int]()
    once = run_planning._look
    monkeypatch.setattr(run_planning, "_look", lambda *given: found.append(1) or once(*given))
    look = SpaceLook(None, LookMemory(FolderPlanCache(tmp_path), "here"))
    with loaded("sorting:sort_parts") as task:
        assert look_at(task, look) == look_at(task, look)
        assert len(found) == 1
        moved = task.assignment.state.with_changes([SetProperty(f"{LAB}Spare", SIZE[0], 0.1)])
        look_at(structs.replace(task, assignment=structs.replace(task.assignment, state=moved)), look)
        assert len(found) == 2
        look_at(task, replace(look, memory=LookMemory(FolderPlanCache(tmp_path), "elsewhere")))
    assert len(found) == 3
