"""Skills that name individuals, at the command line: they are planned with, and what is left out is said."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from oracle.well_typed import mistakes
from skillc.cli.main import skillc

HEAD = """
use sumo
prefix lab: <http://example.org/lab#>
class Spot < Object
class Cart < Object
relation standsAt(Cart, Spot) functional
relation feeds(Spot, Spot) sub skiros:hasA
property parked(Cart): Bool
property load(Cart): Mass
"""
DRIVE = """
skill Drive {
    in    cart: Cart
    in    to:   Spot
    infer from: Spot
    pre   cart standsAt from
    post  cart standsAt to
    duration 10 s
}
impl drive of Drive { run python "nobody:Needs" }
"""
GO_HOME = """
skill GoHome {
    in    cart: Cart
    post  cart standsAt lab:Home
    duration 3 s
}
impl home of GoHome { run python "nobody:Needs" }
"""
PARK = """
skill Park {
    in    cart: Cart
    opt   spot: Spot = lab:Home
    pre   cart standsAt spot
    post  cart.parked == true
    duration 2 s
}
impl park of Park { run python "nobody:Needs" }
"""
SEND = """
skill Send {
    in    cart: Cart
    opt   spot: Spot = lab:Home
    post  cart standsAt spot
    duration 1 s
}
impl send of Send { run python "nobody:Needs" }
"""
TELEPORT = """
skill Teleport {
    in    cart: Cart
    in    to:   Spot
    in    strength: Mass
    post  cart standsAt to
    duration 1 s
}
impl teleport of Teleport { run python "nobody:Needs" }
"""
WEIGH = """
skill Weigh {
    in    cart: Cart
    in    most: Mass
    post  cart.load == 1 kg
    duration 1 s
}
impl weigh of Weigh { run python "nobody:Needs" }
"""
TTL = "@prefix lab: <http://example.org/lab#> . @prefix lib: <https://w3id.org/skillc/library/lib#> .\n"
SCENE = "lab:S1 a lib:Spot . lab:Cart-1 a lib:Cart ; lib:standsAt lab:S1 .\n"
HOME = "lab:Home a lib:Spot .\n"
PARKED = "lab:Cart-1.parked == true"


@pytest.fixture
def lib(tmp_path: Path) -> Path:
    """Return an empty library with a scene."""
    folder = tmp_path / "lib"
    folder.mkdir()
    (folder / "scene.ttl").write_text(TTL + SCENE + HOME, "utf-8")
    return folder


def run(*arguments: str) -> Result:
    result = CliRunner().invoke(skillc, arguments)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def plan(lib: Path, goal: str, *skills: str, options: tuple[str, ...] = ()) -> Result:
    (lib / "lib.skill").write_text("".join((HEAD, *skills)), "utf-8")
    scene = ("--library", str(lib), "--scene", str(lib / "scene.ttl"), "--goal", goal)
    return run("plan", *scene, "--no-plan-cache", *options)


def test_a_skill_that_names_an_individual_is_planned_with(lib: Path) -> None:
    said = plan(lib, "lab:Cart-1 standsAt lab:Home", DRIVE, GO_HOME)
    assert said.stdout.splitlines()[0] == "1  GoHome(cart: lab:Cart-1)"
    assert "1 step, 3 s expected, proved optimal" in said.stdout


def test_an_optional_individual_keeps_its_default_in_conditions_and_posts(lib: Path) -> None:
    assert "12 s expected, proved optimal" in plan(lib, PARKED, DRIVE, PARK).stdout
    sent = plan(lib, PARKED, DRIVE, PARK, SEND).stdout
    assert sent.splitlines()[0] == "1  Send(cart: lab:Cart-1)" and "3 s expected, proved optimal" in sent


def test_another_individual_as_the_default_of_an_implementation_is_no_effect_of_the_skill(lib: Path) -> None:
    other = SEND.replace("{ run python", "{\n    refine spot: Spot = lab:S1\n    run python")
    said = plan(lib, "lab:Cart-1 standsAt lab:Home", other)
    assert said.exit_code == 3 and said.stdout.startswith("no plan was found")
    assert "its implementation `send` has another default for `spot`" in said.stdout


def test_a_scene_without_the_individual_says_so_and_nothing_is_proved(lib: Path) -> None:
    (lib / "scene.ttl").write_text(TTL + SCENE + "lab:S2 a lib:Spot .\n", "utf-8")
    away = plan(lib, "lab:Cart-1 standsAt lab:S2", DRIVE, GO_HOME).stdout
    assert "1 step, 10 s expected, optimal for the skills that can be planned with" in away
    missing = "planned without GoHome: it names `lab:Home` (lib.skill:23), which is not in the scene"
    assert f"{missing}; a better plan may need it" in away
    none = plan(lib, PARKED, DRIVE, PARK)
    assert none.exit_code == 3 and none.stdout.startswith("no plan was found: ")
    assert "Park is left out of planning: it names `lab:Home` (lib.skill:23), which is not in the scene" in none.stdout


def test_an_individual_of_another_class_cannot_be_had(lib: Path) -> None:
    (lib / "scene.ttl").write_text(TTL + SCENE + "lab:Home a lib:Cart .\n", "utf-8")
    assert plan(lib, PARKED, DRIVE, PARK).stdout.startswith("there is no plan: ")


def test_what_cannot_be_planned_with_is_named_unless_it_makes_no_difference(lib: Path) -> None:
    said = plan(lib, "lab:Cart-1 standsAt lab:Home", DRIVE, TELEPORT).stdout
    assert "10 s expected, optimal for the skills that can be planned with" in said
    assert "planned without Teleport: its parameter `strength` is no thing" in said
    assert "proved optimal" in plan(lib, "lab:Cart-1 standsAt lab:Home", DRIVE, WEIGH).stdout
    assert "proved optimal" in plan(lib, "lab:Cart-1 standsAt lab:S1", DRIVE, TELEPORT).stdout, (
        "no steps are the fewest"
    )


def test_that_there_is_no_plan_is_proved_where_all_can_be_planned_with(lib: Path) -> None:
    assert plan(lib, PARKED, DRIVE).stdout.startswith("there is no plan: ")
    join = "skill Join {\n    in a: Spot\n    in n: Mass\n    post a feeds lab:Home\n}\n"
    said = plan(lib, "lab:S1 feeds lab:Home", DRIVE, join + 'impl j of Join { run python "nobody:Needs" }\n')
    assert said.stdout.startswith("no plan was found: ") and "Join is left out of planning" in said.stdout


def test_machines_get_the_same(lib: Path) -> None:
    told = json.loads(plan(lib, "lab:Cart-1 standsAt lab:Home", DRIVE, TELEPORT, options=("--json",)).stdout)
    assert (told["plan_optimal"], told["optimal"]) == (False, "optimal for the filtered problem")
    assert told["quality"] == "optimal for the skills that can be planned with"
    (left_out,) = (each for each in told["left_out"] if not each["harmless"])
    assert left_out["kind"] == "skills" and left_out["what"] == ["Teleport"]
    timed = plan(lib, "lab:Cart-1 standsAt lab:Home", DRIVE, TELEPORT, options=("--json", "--minimise", "makespan"))
    assert json.loads(timed.stdout)["plan_optimal"] is False


def test_nothing_is_done_that_an_axiom_forbids(lib: Path) -> None:
    link = "skill Link {\n    in a: Spot\n    in b: Spot\n    post a feeds b\n}\n"
    link += 'impl l of Link { run python "nobody:Needs" }\n'
    assert "proved optimal" in plan(lib, "lab:S1 feeds lab:Home", link).stdout
    cut = "skill Cut {\n    in a: Spot\n    in b: Spot\n    post not a feeds b\n}\n"
    cut += 'impl c of Cut { run python "nobody:Needs" }\n'
    (lib / "scene.ttl").write_text(TTL + SCENE + HOME + "lab:Home lib:feeds lab:S1 .\n", "utf-8")
    opposite = plan(lib, "lab:S1 feeds lab:Home", link)
    assert opposite.stdout.startswith("there is no plan: "), "asymmetric"
    turned = plan(lib, "lab:S1 feeds lab:Home", link, cut).stdout
    assert [line.split("(")[0] for line in turned.splitlines()[:2]] == ["1  Cut", "2  Link"]


def test_both_domains_declare_the_constants(lib: Path) -> None:
    plan(lib, PARKED, DRIVE, PARK, GO_HOME)
    assert run("compile", str(lib), "-o", str(lib / "build")).exit_code == 0
    for name in ("domain.pddl", "domain.temporal.pddl"):
        text = (lib / "build" / name).read_text("utf-8")
        assert "(:constants\n    home - spot\n  )" in text and mistakes(text) == []
    names = json.loads((lib / "build/library.json").read_text("utf-8"))["names"]
    assert names["home"] == "http://example.org/lab#Home"


def test_check_says_that_a_task_cannot_be_planned_without_claiming_that_nothing_does_it(lib: Path) -> None:
    task = f'task park {{\n    scene "scene.ttl"\n    goal  {PARKED}\n}}\n'
    strange = PARK.replace("in    cart: Cart", "in    cart: Cart\n    in    n: Mass")
    (lib / "lib.skill").write_text(HEAD + DRIVE + strange + task, "utf-8")
    said = run("check", str(lib)).output
    assert "`park` has a goal that no plan can be made for in its scene" in said
