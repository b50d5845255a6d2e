"""Planning in a worker: its answer is that of planning here, and no way to fail is more than a task not started."""

from __future__ import annotations

import faulthandler
import os
import signal
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import pytest
from msgspec.structs import replace

from planning.test_process import program
from plans.depot import CONTAIN, contain, goal, iri, library, world
from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, NotStarted, PreparedTask
from skillc_runtime.execution.planning_job import PlanningJob, Preparation, find_arrival_problem
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.plans.plan_body import build_plan_body
from skillc_runtime.execution.task_planning import replan_task
from skillc_runtime.planning.arrangement import InSeries
from skillc_runtime.planning.fast_downward.solver import FastDownward, Programs
from skillc_runtime.planning.plan import Plan, PlanResult
from skillc_runtime.planning.planners import find_planners
from skillc_runtime.planning.progress import ReportProgress, ignore_progress
from skillc_runtime.planning.schedule import Planners
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.recording.failure import Failure
from skillc_runtime.world.state.changes import RemoveIndividual, RemoveRelation
from skillc_runtime.world.state.world_state import WorldState
from waiting import LONG_S, wait_until

STATE = world({"carl": "c", "dora": "d"}, {"crate": "a", "box": "d"})
SLIPPED = Failure(kind="body", message="it slipped")
BOTH = "lab:b contain lab:crate and lab:b contain lab:box"


def carry(text: str = BOTH, state: WorldState = STATE) -> Assignment:
    return Assignment("carry", state, AchieveGoal(goal(text, state)))


def finished(job: PlanningJob) -> Preparation:
    answer = job.wait(LONG_S)
    assert answer is not None
    return answer


def failed(*implementations: str, crate: str = "crate") -> FailedSteps:
    """Return carl's attempts to load the crate, or to unload it, which failed."""
    failures = FailedSteps(library())
    loaded = STATE.with_changes([RemoveRelation(iri("a"), CONTAIN, iri(crate)), contain("carl", crate)])
    for each in implementations:
        skill, _, name = each.partition(".")
        place = {"from": iri("a")} if skill == "Load" else {"to": iri("b")}
        arguments = {"robot": iri("carl"), "crate": iri(crate), **place}
        failures.add(skill, arguments, name, STATE if skill == "Load" else loaded, SLIPPED, 0)
    return failures


ASSIGNMENTS: list[tuple[Assignment, FailedSteps]] = [
    (carry(), FailedSteps(library())),
    (carry(), failed("Load.forks")),
    (carry("lab:b contain lab:crate"), failed("Unload.lower")),
    (carry("lab:b contain lab:crate"), failed("Unload.lower", "Unload.tilt")),
    (carry("lab:b contain lab:crate", world({}, {"crate": "a"})), FailedSteps(library())),
    (replace(carry(), objective=AchieveGoal(goal(BOTH, STATE), "makespan")), FailedSteps(library())),
    (carry(state=STATE.with_changes([RemoveIndividual(iri("dora"))])), FailedSteps(library())),
]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("assignment", "failures", "start"),
    [
        *((*each, "fork") for each in ASSIGNMENTS),
        *((*each, "thread") for each in ASSIGNMENTS[2:4]),
        *(pytest.param(*each, "spawn", marks=pytest.mark.sim) for each in ASSIGNMENTS[3:5]),
    ],
)
def test_the_answer_is_that_of_planning_in_this_process(assignment, failures, start) -> None:
    planners = replace(find_planners(), for_makespan=None)  # CP-SAT may answer otherwise the second time
    with PlanningJob(assignment, library(), failures, partial(replace, planners), start=start) as job:
        answer = finished(job)
    assert answer == replan_task(assignment, library(), failures, planners)
    assert answer is job.poll()


def test_the_assignments_have_answers_of_both_kinds() -> None:
    kinds = {type(replan_task(each, library(), failures, Planners((AStar(),), None))) for each, failures in ASSIGNMENTS}
    assert kinds == {PreparedTask, NotStarted}


@dataclass(frozen=True, slots=True)
class Odd:
    """A planner that does something else."""

    does: Callable[[], object]
    name: str = "odd"

    def plan(self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
        self.does()
        raise AssertionError("it came back")


def odd_job(does: Callable[[], object], **options) -> PlanningJob:
    return PlanningJob(carry(), library(), find_planners=partial(Planners, (Odd(does),), None), **options)


def sleep() -> None:
    time.sleep(600.0)


def fail() -> None:
    raise ArithmeticError("nothing adds up")


def leave() -> None:
    os._exit(7)


def exit_politely() -> None:
    raise SystemExit(0)


def crash() -> None:
    faulthandler.disable()
    os.kill(os.getpid(), signal.SIGSEGV)


@pytest.mark.parametrize(
    ("does", "why"),
    [
        (fail, "planning failed: ArithmeticError: nothing adds up (test_planning_job.py:"),
        (exit_politely, "planning failed: SystemExit: 0"),
        (leave, "planning failed: its process ended with code 7"),
        (crash, "planning failed: its process ended with signal 11"),
    ],
)
def test_a_worker_that_fails_is_a_task_that_does_not_start(does: Callable[[], object], why: str) -> None:
    with odd_job(does) as job:
        answer = finished(job)
    assert isinstance(answer, NotStarted) and answer.reason.startswith(why)


def test_a_worker_that_passes_its_deadline_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("skillc_runtime.execution.planning_job.GRACE_S", 0.1)
    with odd_job(sleep, deadline_s=0.1) as job:
        assert finished(job) == NotStarted("planning was stopped: it ran out of time")


def test_a_worker_is_ended_when_its_token_is_cancelled() -> None:
    cancel = CancelToken()
    with odd_job(sleep, cancel=cancel) as job:
        assert job.poll() is None
        cancel.cancel("the operator stopped the task")
        assert job.poll() == NotStarted("planning was stopped: the operator stopped the task")


def test_an_answer_stays_when_the_job_is_killed_later() -> None:
    with PlanningJob(carry(), library()) as job:
        answer = finished(job)
    job.kill()
    assert isinstance(answer, PreparedTask) and job.poll() is answer


def hanging_planners(folder: Path) -> tuple[Planners, Path]:
    """Return Fast Downward with a search that hangs in a child of its own, and the file with the child's id."""
    pid = folder / "pid"
    translate = program(folder, "translate", 'touch task.sas; echo "Translator axioms: 0"')
    search = program(folder, "search", f"sleep 600 & echo $! > {pid}.new; mv {pid}.new {pid}; wait")
    return Planners((FastDownward(Programs((translate,), search, (search,))),), None), pid


def runs(pid: int) -> bool:
    """Whether a process runs; one that only waits to be reaped does not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


@pytest.mark.parametrize("start", ["fork", "spawn"])
def test_kill_ends_the_planners_and_leaves_no_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, start: str
) -> None:
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    monkeypatch.setenv("TMPDIR", str(tmp_path / "temporary"))
    planners, pid = hanging_planners(tmp_path)
    with PlanningJob(carry(), library(), find_planners=partial(replace, planners), start=start) as job:
        wait_until(pid.exists)
        assert list((tmp_path / "temporary").iterdir())
    assert job.poll() == NotStarted("planning was stopped: it was cancelled")
    wait_until(lambda: not runs(int(pid.read_text())))
    wait_until(lambda: not list((tmp_path / "temporary").iterdir()))


@pytest.mark.parametrize("end", ["worker", "parent"])
def test_planners_end_with_the_worker_and_the_worker_with_its_parent(tmp_path: Path, end: str) -> None:
    planners, pid = hanging_planners(tmp_path)
    parent = os.fork()
    if not parent:
        job = PlanningJob(carry(), library(), find_planners=partial(replace, planners))
        (tmp_path / "worker").write_text(str(job._worker.pid))
        job.wait(600.0)
        os._exit(0)
    try:
        wait_until(pid.exists)
        worker = int((tmp_path / "worker").read_text())
        assert runs(worker) and runs(int(pid.read_text()))
        os.kill(parent if end == "parent" else worker, signal.SIGKILL)
        wait_until(lambda: not runs(worker) and not runs(int(pid.read_text())))
    finally:
        os.kill(parent, signal.SIGKILL)
        os.waitpid(parent, 0)


def arrived(text: str = BOTH) -> PreparedTask:
    prepared = replan_task(carry(text), library(), FailedSteps(library()))
    assert isinstance(prepared, PreparedTask)
    return prepared


def problem(prepared: PreparedTask, changes: Sequence) -> str | None:
    return find_arrival_problem(prepared, library(), STATE.with_changes(changes))


def test_a_plan_is_taken_while_the_world_is_as_it_was_where_it_matters() -> None:
    assert find_arrival_problem(arrived(), library(), STATE) is None
    elsewhere = world({"carl": "c", "dora": "d"}, {"crate": "a", "box": "d", "sack": "c"})
    assert find_arrival_problem(arrived(), library(), elsewhere) is None


def test_a_plan_whose_step_is_no_longer_possible_is_sent_back() -> None:
    moved = [RemoveRelation(iri("a"), CONTAIN, iri("crate")), contain("d", "crate")]
    why = problem(arrived("lab:b contain lab:crate"), moved)
    assert why is not None and "Load" in why and "contain" in why


def test_a_plan_that_no_longer_leads_to_the_goal_is_sent_back() -> None:
    prepared = arrived("lab:b contain lab:crate")
    assert prepared.planned is not None
    shorter = replace(prepared.planned.solved, plan=Plan(prepared.planned.solved.plan.steps[:-1], 1.0))
    prepared = replace(prepared, planned=replace(prepared.planned, solved=shorter))
    why = problem(prepared, [RemoveIndividual(iri("box"))])
    assert why is not None and "the goal does not hold after the plan" in why


def test_a_plan_whose_steps_depend_on_each_other_in_another_way_is_sent_back() -> None:
    prepared = arrived("lab:dora at lab:c and lab:carl at lab:d")
    assert prepared.planned is not None
    in_series = InSeries(tuple(range(len(prepared.planned.solved.plan.steps))))
    prepared = replace(prepared, body=build_plan_body(prepared.planned.solved.plan, in_series, library()))
    assert problem(prepared, [RemoveIndividual(iri("box"))]) == "its steps now depend on each other in another way"
