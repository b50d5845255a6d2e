"""Several tasks in one plan: those that come first have precedence, and each keeps its own time."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner

from plans.depot import LAB, Depot, goal, library, world
from skillc.cli.main import skillc
from skillc_model.conditions import And
from skillc_model.skills import TaskPart
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, NotStarted, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.planning.planners import Planners, choose_planner, find_planners
from skillc_runtime.recording.events import Event, TaskStarted
from skillc_runtime.world.state.model import WorldModel

PROJECT = """use skiros, skillc
prefix lab: <http://example.org/lab#>
skill Go {
    in    robot: MobileRobot
    in    to:    Location
    infer from:  Location
    pre   robot at from
    post  robot at to
}
task one { scene "a.ttl" goal lab:robot-1 at lab:b }
task two { scene "a.ttl" goal lab:robot-1 at lab:c minimise cost }
task three { scene "a.ttl" goal lab:robot-1 at lab:c minimise makespan }
task other { scene "b.ttl" goal lab:robot-1 at lab:c }
task body { scene "a.ttl" do Go(robot: lab:robot-1, to: lab:b) }
"""
SCENE = """@prefix lab: <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
lab:a a skiros:Location . lab:b a skiros:Location . lab:c a skiros:Location .
lab:robot-1 a skillc:MobileRobot ; skiros:at lab:a .
"""


def built_in() -> Planners:
    return choose_planner(find_planners(), "built-in")


def prepare(tasks: dict[str, tuple[str, float | None]], robots: str = "one") -> PreparedTask | NotStarted:
    """Plan for goals with their times, for crates in `a` and `c` and robots that are in `a`."""
    state = world(dict.fromkeys(robots.split(), "a"), {"near": "a", "far": "c"})
    parts = tuple(TaskPart(name=name, goal=goal(text, state), within_s=time) for name, (text, time) in tasks.items())
    objective = AchieveGoal(And(tuple(each.goal for each in parts)))
    return prepare_task(Assignment("both", state, objective, parts=parts), library(), planners=built_in())


def moved(prepared: PreparedTask | NotStarted) -> list[str]:
    assert isinstance(prepared, PreparedTask) and prepared.planned is not None, prepared
    return [each.arguments["crate"].rpartition("#")[2] for each in prepared.planned.steps if each.skill == "Load"]


NEAR, FAR = "lab:b contain lab:near", "lab:d contain lab:far"


@pytest.mark.parametrize(
    ("near_s", "far_s", "order"),
    [(None, None, ["near", "far"]), (None, 20.0, ["far", "near"]), (30.0, 20.0, ["far", "near"]), (9.0, 10.0, None)],
)
def test_a_task_is_done_in_its_time(near_s: float | None, far_s: float | None, order: list[str] | None) -> None:
    for reverse in (False, True):
        tasks = [("near", (NEAR, near_s)), ("far", (FAR, far_s))]
        prepared = prepare(dict(reversed(tasks) if reverse else tasks))
        if order is None:
            assert isinstance(prepared, NotStarted)
            assert "has to be done within" in prepared.reason and "it is done after" in prepared.reason
        else:
            assert moved(prepared) == order, "the shorter plan, unless a task would be late"


@pytest.mark.parametrize("names", [("near", "far"), ("far", "near")])
def test_of_tasks_that_want_one_robot_the_first_is_done_first(names: tuple[str, str]) -> None:
    start = world({"one": "a"}, {"near": "a", "far": "a"})
    goals = [goal(f"lab:a contain lab:{each} and lab:{each}.turned == true", start) for each in names]
    parts = tuple(TaskPart(name=name, goal=each) for name, each in zip(names, goals, strict=True))
    assignment = Assignment("both", start, AchieveGoal(And(tuple(goals))), parts=parts)
    assert moved(prepare_task(assignment, library(), planners=built_in())) == [*names]


def test_tasks_of_two_robots_run_at_the_same_time() -> None:
    prepared = prepare({"near": (NEAR, 20.0), "far": (FAR, 14.0)}, "one two")
    assert isinstance(prepared, PreparedTask) and prepared.planned is not None
    assert {each.arguments["robot"] for each in prepared.planned.steps} == {LAB + "one", LAB + "two"}


def test_a_run_ends_when_one_of_its_tasks_is_late() -> None:
    prepared = prepare({"far": (FAR, 15.0), "near": (NEAR, None)})
    assert isinstance(prepared, PreparedTask)
    for fails, ends in ((0, "succeeded"), (1, "failed")):
        events: list[Event] = []

        def refuse(step: str, number: int, times: int = fails) -> bool:
            return step.startswith("one far d") and number <= times

        depot = Depot(WorldModel(prepared.assignment.state), fails=refuse)
        end = execute_task(prepared, library(), depot, [events.append])  # type: ignore[arg-type]
        assert isinstance(events[0], TaskStarted) and [each.name for each in events[0].parts] == ["far", "near"]
        assert end.status == ends
    assert "`far` was not done within 15 s" in repr(end)


@pytest.fixture
def call(tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., str]:
    (tmp_path / "go.skill").write_text(PROJECT, encoding="utf-8")
    for name in ("a.ttl", "b.ttl"):
        (tmp_path / name).write_text(SCENE, encoding="utf-8")
    (tmp_path / "skillc.toml").write_text('name = "go"\nedition = 2\n\n[tool.run]\nbackend = "symbolic"\n')
    monkeypatch.chdir(tmp_path)
    return lambda task, *more: CliRunner().invoke(skillc, ["plan", task, *more]).output


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        ("one --beside other", "`other` does not have the scene of `one`"),
        ("one --beside one", "the task `one` is named twice"),
        ("one --beside body", "the task `body` has no goal: only tasks with goals are planned together"),
        ("two --beside three", "minimise the same: `two` minimises cost, `three` minimises makespan"),
        ("one --beside two x=1", "several tasks at once take no arguments"),
        ("one --beside nothing", "nothing"),
        ("one --beside two", "there is no plan"),
    ],
)
def test_what_cannot_be_planned_together_is_said(call: Callable[..., str], words: str, answer: str) -> None:
    assert answer in call(*words.split())
