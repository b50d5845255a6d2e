"""What `skillc plan` says about a plan in a large scene, to people and to machines."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc_runtime.planning import planners

SKILLS = """
use sumo
class Depot < Object
class Crate < Object
class Truck < Object
relation in_(Crate, Object) functional
relation stores(Object, Crate) inverse in_
property weight(Crate): Mass

skill Load {
    in    truck: Truck
    in    crate: Crate
    infer from:  Depot
    pre   from stores crate
    pre   light: crate.weight < 5 kg
    pre   not truck stores _
    post  truck stores crate
    duration crate.weight / (1 kg) * (1 s)
}
impl forks of Load { run python "nobody:Needs" }
"""
HEAD = "@prefix lab: <http://example.org/lab#> . @prefix lib: <https://w3id.org/skillc/library/depot#> .\n"


@pytest.fixture(scope="module")
def depot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with skills and a scene of 200 crates, of which crate 7 is light and crate 9 too heavy."""
    folder = tmp_path_factory.mktemp("planning") / "depot"
    folder.mkdir()
    (folder / "depot.skill").write_text(SKILLS, "utf-8")
    weights = {7: 1.0, 9: 6.0}
    crates = [
        f"lab:d{n} a lib:Depot ; lib:stores lab:c{n} . lab:c{n} a lib:Crate ; lib:weight {weights.get(n, 2.0)} ."
        for n in range(200)
    ]
    (folder / "scene.ttl").write_text("\n".join((HEAD, "lab:truck a lib:Truck .", *crates)), "utf-8")
    return folder


def plan(depot: Path, goal: str, *options: str) -> Result:
    scene = ("--library", str(depot), "--scene", str(depot / "scene.ttl"), "--goal", goal)
    result = CliRunner().invoke(skillc, ["plan", *scene, "--no-plan-cache", "--deadline", "600", *options])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def test_the_answer_names_what_it_was_made_without(depot: Path) -> None:
    said = plan(depot, "lab:truck stores lab:c150")
    assert said.exit_code == 0
    assert "1 step, 2 s expected, proved optimal" in said.stdout
    assert "planned without lab:d" in said.stdout and "more: they are far from what the goal refers to" in said.stdout
    assert said.stdout.rstrip().endswith("yet no better plan needs them")


def test_machines_get_the_whole_list(depot: Path) -> None:
    told = json.loads(plan(depot, "lab:truck stores lab:c150", "--prove", "--json").stdout)
    assert told["optimal"] == "proven" and told["plan_optimal"]
    far = [each for each in told["left_out"] if not each["harmless"]]
    assert len(far) == 1 and len(far[0]["what"]) > 150 and all(":d" in each for each in far[0]["what"])
    needless = next(each for each in told["left_out"] if "no step that helps" in each["why"])
    assert needless["harmless"] and len(needless["what"]) == 199 and "lab:c150" not in needless["what"]


def test_a_goal_out_of_reach_of_a_large_scene_says_why(depot: Path) -> None:
    said = plan(depot, "lab:truck stores lab:c9")
    assert said.exit_code == 3
    assert "Load needs crate.weight < 5 kg for lab:c9, which nothing fulfils" in said.stdout


def test_a_proof_goes_with_work_alone(depot: Path) -> None:
    said = plan(depot, "lab:truck stores lab:c9", "--prove", "--minimise", "makespan")
    assert said.exit_code == 2 and "requires to minimise work" in said.stderr


def test_what_the_planner_gets_is_written_and_solved_by_it_alone(depot: Path, tmp_path: Path) -> None:
    pddl = tmp_path / "pddl"
    said = plan(depot, "lab:truck stores lab:c7", "--planner", "built-in", "--write-pddl", str(pddl))
    assert said.exit_code == 0 and "(built-in A*)" in said.stdout
    domain, problem = ((pddl / f"{kind}-1.pddl").read_text() for kind in ("domain", "problem"))
    assert "(:action load" in domain
    assert "c7" in problem.partition("(:goal")[2] and "(:init" in problem
    again = plan(depot, "lab:truck stores lab:c7", "--planner", "fast-downward", "--write-pddl", str(pddl))
    assert again.exit_code == 0 and "(Fast Downward)" in again.stdout
    assert (pddl / "problem-1.pddl").read_text() == problem


def test_a_folder_that_cannot_be_written_is_told(depot: Path, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    said = plan(depot, "lab:truck stores lab:c7", "--write-pddl", str(tmp_path / "file" / "below"))
    assert said.exit_code != 0 and "below: Not a directory" in said.stderr


def test_a_planner_that_is_not_installed_is_told(depot: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planners, "find_fast_downward", lambda: None)
    said = plan(depot, "lab:truck stores lab:c7", "--planner", "fast-downward")
    assert said.exit_code != 0 and "Fast Downward is not installed; the extra `planner` installs it" in said.stderr
