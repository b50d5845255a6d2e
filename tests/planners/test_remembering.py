"""Plans that were found before are taken again: for the same problem, whole, by several at once."""

from __future__ import annotations

import json
import multiprocessing
import os
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from click.testing import CliRunner
from msgspec.structs import replace

from planners.test_schedule_simulation import BOTH, GOOD, WORLD
from plans import depot
from skillc.cli.main import skillc
from skillc.services.planning import plan_cache
from skillc.services.planning.plan_cache import FolderPlanCache
from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.cache import CachingPlanner, CachingScheduler
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.problem.pose import pose_problem
from skillc_runtime.planning.progress import ReportProgress, ignore_progress
from skillc_runtime.planning.schedule import FoundSchedule, Schedule
from skillc_runtime.planning.search.astar import AStar

PROBLEM = pose_problem(depot.library(), WORLD, BOTH).problem
OTHER = pose_problem(depot.library(), WORLD, depot.goal("lab:c contain lab:crate", WORLD)).problem
ANSWER = AStar().plan(PROBLEM, CancelToken(20.0))


@dataclass
class Counting:
    """A planner and scheduler that counts how often it is asked, and answers as if its time had been up if it is to."""

    answer: PlanResult = ANSWER
    name: str = "counting"
    asked: list[int] = field(default_factory=list)

    def plan(self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
        """Return the answer."""
        self.asked.append(round(cancel.remaining_s))
        return self.answer

    def schedule(
        self,
        problem: Problem,
        first: Schedule | None,
        cancel: CancelToken,
        report: ReportProgress = ignore_progress,
    ) -> FoundSchedule | GaveUp:
        """Return a schedule."""
        self.asked.append(round(cancel.remaining_s))
        return FoundSchedule(GOOD, 9.0)


def test_the_same_problem_is_not_solved_twice(tmp_path: Path) -> None:
    planner = Counting()
    first = CachingPlanner(planner, FolderPlanCache(tmp_path), "one 1.0")
    assert isinstance(ANSWER, Solved)
    assert [first.plan(PROBLEM, CancelToken(10.0)) for _ in range(3)] == [ANSWER] * 3
    assert len(planner.asked) == 1
    assert CachingPlanner(planner, FolderPlanCache(tmp_path), "one 1.0").plan(PROBLEM, CancelToken(99.0)) == ANSWER
    assert len(planner.asked) == 1
    first.plan(OTHER, CancelToken(10.0))
    CachingPlanner(planner, FolderPlanCache(tmp_path), "one 1.1").plan(PROBLEM, CancelToken(10.0))
    renamed = replace(PROBLEM, names={name: iri + "x" for name, iri in PROBLEM.names.items()})
    first.plan(renamed, CancelToken(10.0))
    assert len(planner.asked) == 4, "another problem, another version, other things"


@pytest.mark.slow
def test_the_same_problem_is_the_same_one_in_every_process(tmp_path: Path) -> None:
    program = """
import sys
from pathlib import Path
from planners.test_remembering import PROBLEM, CachingPlanner, CancelToken, Counting, FolderPlanCache
CachingPlanner(Counting(), FolderPlanCache(Path(sys.argv[1])), "one 1.0").plan(PROBLEM, CancelToken(10.0))
"""
    path = os.pathsep.join(each for each in sys.path if each)
    for seed in ("1", "2"):
        environment = {**os.environ, "PYTHONPATH": path, "PYTHONHASHSEED": seed}
        subprocess.run((sys.executable, "-c", program, str(tmp_path)), env=environment, check=True)
    assert len(list(tmp_path.iterdir())) == 1


def test_schedules_are_remembered_too(tmp_path: Path) -> None:
    scheduler = Counting()
    remembering = CachingScheduler(scheduler, FolderPlanCache(tmp_path), "one 1.0")
    found = [remembering.schedule(PROBLEM, None, CancelToken(10.0)) for _ in range(2)]
    assert found == [FoundSchedule(GOOD, 9.0)] * 2
    assert len(scheduler.asked) == 1
    remembering.schedule(PROBLEM, GOOD, CancelToken(10.0))
    assert len(scheduler.asked) == 2, "the search would go on from another schedule"


def test_who_has_more_time_than_a_plan_that_was_cut_short_asks_again(tmp_path: Path) -> None:
    assert isinstance(ANSWER, Solved)
    planner = Counting(replace(ANSWER, optimal="best found"))
    remembering = CachingPlanner(planner, FolderPlanCache(tmp_path), "one 1.0")
    for seconds in (0.0, 0.0, 10.0, 99.0, 5.0):
        remembering.plan(PROBLEM, CancelToken(seconds))
    assert planner.asked == [0, 10], "the second was not cut short, so it is good for all"


@dataclass
class Interrupted(Counting):
    """A planner that is cancelled while it plans."""

    def plan(self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
        """Return what was found until then."""
        cancel.cancel("it was stopped")
        return super().plan(problem, cancel)


def test_what_was_found_until_a_search_was_cancelled_is_not_kept(tmp_path: Path) -> None:
    planner = Interrupted()
    remembering = CachingPlanner(planner, FolderPlanCache(tmp_path), "one 1.0")
    assert [remembering.plan(PROBLEM, CancelToken(10.0)) for _ in range(2)] == [ANSWER] * 2
    assert len(planner.asked) == 2


@pytest.mark.parametrize("answer", [GaveUp("no"), Unsolvable("no")])
def test_only_plans_are_remembered(tmp_path: Path, answer: PlanResult) -> None:
    planner = Counting(answer)
    remembering = CachingPlanner(planner, FolderPlanCache(tmp_path), "one 1.0")
    assert [remembering.plan(PROBLEM, CancelToken(10.0)) for _ in range(2)] == [answer] * 2
    assert len(planner.asked) == 2


def damaged(content: bytes) -> tuple[bytes, ...]:
    return (b"", content[:-1], content[: len(content) // 2], content[::-1], b"x" + content, b"{}", b"\xff" * 100)


def test_what_is_damaged_counts_as_missing_and_is_replaced(tmp_path: Path) -> None:
    planner = Counting()
    remembering = CachingPlanner(planner, FolderPlanCache(tmp_path), "one 1.0")
    remembering.plan(PROBLEM, CancelToken(10.0))
    (file,) = tmp_path.iterdir()
    whole = file.read_bytes()
    for number, content in enumerate(damaged(whole), 2):
        file.write_bytes(content)
        for _ in range(2):  # the second answer comes from the file
            assert remembering.plan(PROBLEM, CancelToken(10.0)) == ANSWER
            assert len(planner.asked) == number
    assert len(planner.asked) == 8


class Plain:
    """A shelf with one thing on it, which is not what it should be."""

    def get(self, key: str) -> bytes | None:
        """Return something else."""
        return b'{"solved": {"plan": 3}, "deadline_s": "soon"}'

    def put(self, key: str, content: bytes) -> None:
        """Forget it."""


def test_what_is_whole_but_something_else_counts_as_missing() -> None:
    planner = Counting()
    assert CachingPlanner(planner, Plain(), "one 1.0").plan(PROBLEM, CancelToken(10.0)) == ANSWER
    assert len(planner.asked) == 1


def test_a_shelf_that_cannot_be_used_only_costs_time(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    planner = Counting()
    remembering = CachingPlanner(planner, FolderPlanCache(tmp_path / "file"), "one 1.0")
    assert [remembering.plan(PROBLEM, CancelToken(10.0)) for _ in range(2)] == [ANSWER] * 2
    assert len(planner.asked) == 2


def test_the_oldest_are_thrown_away(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(plan_cache, "MOST_PLANS", 5)
    shelf = FolderPlanCache(tmp_path)
    (tmp_path / "somebody's folder").mkdir()
    for number in range(20):
        shelf.put(str(number), b"content")
    assert len(list(tmp_path.iterdir())) == 6
    assert shelf.get("19") == b"content"


def _use(folder: Path) -> int:
    """Plan often on a shelf that others use, of which all but a few answers are thrown away; return the wrong ones."""
    plan_cache.MOST_PLANS = 2
    remembering = CachingPlanner(Counting(), FolderPlanCache(folder), "one 1.0")
    wrong = 0
    for _ in range(15):
        wrong += remembering.plan(PROBLEM, CancelToken(10.0)) != ANSWER
        FolderPlanCache(folder).put("other", b"something")
    return wrong


def test_several_processes_share_a_shelf(tmp_path: Path) -> None:
    with multiprocessing.get_context("fork").Pool(4) as pool:
        assert pool.map(_use, [tmp_path] * 4) == [0] * 4


def test_the_command_takes_plans_again_unless_told_not_to(own_cache: Path) -> None:
    command = ["plan", "clean_table", "--json"]
    assert CliRunner().invoke(skillc, [*command, "--no-plan-cache"]).exit_code == 0
    assert not (own_cache / "plans").exists()
    first, second = (json.loads(CliRunner().invoke(skillc, command).stdout) for _ in range(2))
    assert first == second and first["status"] == "solved"
