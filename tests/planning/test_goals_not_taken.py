"""Goals that hold in the scene need no planner; of goals that no planner can take nothing is claimed."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc

SKILLS = """
use sumo
class Room < Object
class Box < Object
class Shelf < Object
relation inside(Object, Object) transitive
relation stands(Shelf, Room) functional sub inside
property isOpen(Box): Bool
property weight(Box): Mass
prefix lab: <http://example.org/lab#>

skill Move {
    in    shelf: Shelf
    in    to:    Room
    post  shelf stands to
    duration 1 s
}
impl move of Move { run python "nobody:Needs" }

skill Open {
    in    box: Box
    post  box.isOpen == true
}
impl open of Open { run python "nobody:Needs" }

skill Weigh {
    in    box: Box
    post  box.weight == 1 kg
    noplan
}
impl weigh of Weigh { run python "nobody:Needs" }
"""
SCENE = """@prefix lab: <http://example.org/lab#> . @prefix lib: <https://w3id.org/skillc/library/lib#> .
lab:Hall a lib:Room . lab:Cellar a lib:Room .
lab:Shelf a lib:Shelf ; lib:stands lab:Hall .
lab:Box a lib:Box ; lib:inside lab:Shelf ; lib:isOpen false ; lib:weight 2.0 .
lab:Chest a lib:Box ; lib:isOpen false .
"""
HOLD = (
    "lab:Box inside lab:Hall",
    "not lab:Box inside lab:Cellar",
    "lab:Box.isOpen == lab:Chest.isOpen",
    "exists r: Room (lab:Box inside r)",
)
NOT_TAKEN = {
    "lab:Box.isOpen != lab:Chest.isOpen": "the goal compares `lib:isOpen`, which skills change",
}


@pytest.fixture
def lib(tmp_path: Path) -> Path:
    """Return a library with a scene."""
    folder = tmp_path / "lib"
    folder.mkdir()
    (folder / "lib.skill").write_text(SKILLS, "utf-8")
    (folder / "scene.ttl").write_text(SCENE, "utf-8")
    return folder


def run(*arguments: str) -> Result:
    result = CliRunner().invoke(skillc, arguments)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def plan(lib: Path, goal: str, *options: str) -> Result:
    return run("plan", "--library", str(lib), "--scene", str(lib / "scene.ttl"), "--goal", goal, *options)


def with_task(lib: Path, goal: str) -> str:
    with (lib / "lib.skill").open("a", encoding="utf-8") as file:
        file.write(f'\ntask t {{\n    scene "scene.ttl"\n    goal  {goal}\n}}\n')
    return f"{lib}:t"


@pytest.mark.parametrize("goal", HOLD)
@pytest.mark.parametrize("options", [(), ("--minimise", "makespan"), ("--prove",)])
def test_a_goal_that_holds_takes_no_steps(lib: Path, goal: str, options: tuple[str, ...]) -> None:
    said = plan(lib, goal, *options)
    assert said.exit_code == 0 and said.stdout.startswith("0 steps, "), said.output
    assert "proved optimal (the world as it is)" in said.stdout


@pytest.mark.parametrize("goal", NOT_TAKEN)
@pytest.mark.parametrize("options", [(), ("--minimise", "makespan"), ("--prove",)])
def test_a_goal_that_no_planner_can_take_is_no_claim(lib: Path, goal: str, options: tuple[str, ...]) -> None:
    said = plan(lib, goal, *options)
    assert said.exit_code == 3 and said.stdout.startswith(f"no plan was searched for: {NOT_TAKEN[goal]}"), said.output


@pytest.mark.parametrize("goal", ["lab:Box inside lab:Cellar", "not lab:Box inside lab:Hall"])
@pytest.mark.parametrize("options", [(), ("--minimise", "makespan"), ("--prove",)])
def test_what_something_is_inside_of_goes_along(lib: Path, goal: str, options: tuple[str, ...]) -> None:
    said = plan(lib, goal, *options)
    assert said.exit_code == 0 and "Move(shelf: lab:Shelf, to: lab:Cellar)\n1 step, " in said.stdout, said.output
    assert "proved optimal" in said.stdout


def test_machines_are_told_whether_a_plan_was_looked_for(lib: Path) -> None:
    holds = json.loads(plan(lib, HOLD[0], "--json").stdout)
    assert (holds["status"], holds["plan"], holds["optimal"]) == ("solved", [], "proven")
    not_taken = json.loads(plan(lib, "lab:Box.isOpen != lab:Chest.isOpen", "--json").stdout)
    assert (not_taken["status"], not_taken["searched"]) == ("gave-up", False)
    impossible = json.loads(plan(lib, "lab:Box.weight == 3 kg", "--json").stdout)
    assert impossible["status"] == "unsolvable", "what planners can take is still proved"


@pytest.mark.parametrize("goal", HOLD)
def test_a_task_whose_goal_holds_has_nothing_wrong(lib: Path, goal: str) -> None:
    task = with_task(lib, goal)
    checked = run("check", str(lib))
    assert checked.exit_code == 0 and "unreachable-goal" not in checked.output
    assert run("plan", task).stdout.startswith("0 steps, ")
    assert run("graph", str(lib), "t", "--plan", "--format", "mermaid").exit_code == 0


@pytest.mark.parametrize("goal", NOT_TAKEN)
def test_a_task_that_no_planner_can_take_is_told_before_it_runs(lib: Path, goal: str) -> None:
    task = with_task(lib, goal)
    checked = run("check", str(lib))
    assert f"`t` has a goal that no plan can be made for in its scene: {NOT_TAKEN[goal]}" in checked.output
    drawn = run("graph", str(lib), "t", "--plan")
    assert drawn.exit_code == 3 and drawn.stderr.startswith("error: no plan was searched for: ")
    ran = run("run", task, "--json")
    assert ran.exit_code == 3 and f"no plan was searched for: {NOT_TAKEN[goal]}" in ran.output
