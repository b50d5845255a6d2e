"""What `skillc plan` proves about durations: exact ones, those of implementations, and those that nobody knows."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc_model.pddl.costs import MOST_UNITS, common_scale, exact_seconds
from skillc_runtime.planning import planners
from skillc_runtime.planning.fast_downward import solver as fast_downward
from skillc_runtime.planning.search import astar

VOCABULARY = """
use sumo
class Part < Object
class SmallPart < Part
property weight(Part): Mass
property wet(Part): Bool
property clean(Part): Bool
property weighed(Part): Bool
"""
SCENE = """
@prefix lab: <http://example.org/lab#> . @prefix lib: <https://w3id.org/skillc/library/wash#> .
lab:big a lib:Part ; lib:weight 2.0 .
lab:small a lib:SmallPart ; lib:weight 1.0 .
lab:wet a lib:SmallPart ; lib:weight 1.0 ; lib:wet true .
lab:light a lib:Part .
"""
WASH = (
    'skill Wash {{ in x: Part\n post x.wet == true\n duration {} }}\nimpl tub of Wash {{ run python "nobody:Needs" }}'
)
DRY = """
skill Dry {{ in x: Part\n pre x.wet == true\n post x.clean == true\n duration {} }}
impl towel of Dry {{ run python "nobody:Needs" }}
"""
BRUSH = "skill Brush {{ in x: Part\n post x.clean == true\n duration {} }}"
HAND = 'impl hand of Brush {{ {} run python "nobody:Needs" }}'

PLANNERS = [
    "built-in A*",
    pytest.param(
        "Fast Downward",
        marks=pytest.mark.skipif(fast_downward.find_fast_downward() is None, reason="the planner is an extra"),
    ),
]


def plan(folder: Path, skills: str, goal: str, planner: str, monkeypatch: pytest.MonkeyPatch, *options: str) -> str:
    """Return what the command says about a goal with one planner, or with the one for schedules."""
    library = folder / "wash"
    library.mkdir()
    (library / "wash.skill").write_text(VOCABULARY + skills, "utf-8")
    (library / "scene.ttl").write_text(SCENE, "utf-8")
    if planner == astar.AStar.name:
        monkeypatch.setattr(planners, "find_fast_downward", lambda: None)
    words = ["plan", "--library", str(library), "--scene", str(library / "scene.ttl"), "--goal", goal]
    result = CliRunner().invoke(skillc, [*words, "--no-plan-cache", *options])
    assert result.exit_code == 0, result.output
    return result.stdout


def last(said: str) -> str:
    return next(line for line in reversed(said.splitlines()) if re.match(r"\d+ steps?, ", line))


@pytest.mark.slow
@pytest.mark.parametrize("planner", PLANNERS)
@pytest.mark.parametrize(
    ("wash", "dry", "brush", "expected"),
    [
        ("0.14 s", "0.14 s", "0.26 s", "1 step, 0.26 s"),
        ("0.14 s", "0.11 s", "0.26 s", "2 steps, 0.25 s"),
        ("0.1 s", "0.2 s", "0.3 s + 1 ms", "2 steps, 0.3 s"),
        ("1 s / 3", "1 s / 3", "0.666 s", "1 step, 0.666 s"),
        ("1 s / 3", "1 s / 3", "0.667 s", "2 steps, 0.666667 s"),
        ("0 s", "0 s", "0.001 s", "2 steps, 0 s"),
        ("10000000 s", "10000000 s", "30000000 s", "2 steps, 2e+07 s"),
    ],
)
def test_durations_are_never_rounded(
    wash: str, dry: str, brush: str, expected: str, planner: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    skills = "\n".join((WASH.format(wash), DRY.format(dry), BRUSH.format(brush), HAND.format("")))
    said = last(plan(tmp_path, skills, "lab:big.clean == true", planner, monkeypatch))
    assert said == f"{expected} expected, proved optimal ({planner})"


@pytest.mark.parametrize("planner", PLANNERS)
def test_durations_that_no_planner_can_add_up_are_rounded_down_and_no_optimum_is_claimed(
    planner: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    skills = "\n".join((WASH.format("0.00001 s"), DRY.format("100000 s"), BRUSH.format("100001 s"), HAND.format("")))
    said = plan(tmp_path, skills, "lab:big.clean == true", planner, monkeypatch, "--json")
    answer = json.loads(said)
    assert answer["duration_s"] == 100000.00001 and answer["at_least_s"] == 100000.0
    assert answer["optimal"] == "optimal for approximate durations" and not answer["plan_optimal"]


OWN = 'impl brush of Brush { refine x: SmallPart\n duration 1 s\n run python "nobody:Needs" }'
DAMP = 'impl damp of Brush { pre x.wet == true\n duration 9 s\n prefer 1\n run python "nobody:Needs" }'


@pytest.mark.parametrize("planner", PLANNERS)
@pytest.mark.parametrize(
    ("thing", "expected"),
    [("big", "2 steps, 6 s"), ("small", "1 step, 1 s"), ("wet", "1 step, 1 s"), ("light", "2 steps, 6 s")],
)
def test_the_duration_of_the_implementation_that_is_taken_counts(
    thing: str, expected: str, planner: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    skills = "\n".join((WASH.format("2 s"), DRY.format("4 s"), BRUSH.format("8 s"), HAND.format(""), OWN))
    if thing == "wet":
        skills = skills.replace("refine x: SmallPart", "refine x: SmallPart\n pre x.wet == true")
    said = last(plan(tmp_path, skills, f"lab:{thing}.clean == true", planner, monkeypatch))
    assert said == f"{expected} expected, proved optimal ({planner})"


@pytest.mark.parametrize("planner", PLANNERS)
def test_an_implementation_that_another_one_precedes_does_not_count(
    planner: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`hand` would be quicker, but `damp` is preferred as soon as the part is wet."""
    skills = "\n".join((WASH.format("2 s"), BRUSH.format("8 s"), HAND.format("duration 3 s\n"), DAMP))
    goal = "lab:big.clean == true and lab:big.wet == true"
    said = plan(tmp_path, skills, goal, planner, monkeypatch)
    assert [line.split("(")[0].split()[1] for line in said.splitlines()[:2]] == ["Brush", "Wash"]
    assert last(said) == f"2 steps, 5 s expected, proved optimal ({planner})"


def test_a_schedule_counts_the_same_durations(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    skills = "\n".join((WASH.format("2 s"), BRUSH.format("8 s"), HAND.format("duration 2.5 s\n"), OWN))
    goal = "lab:big.clean == true and lab:small.clean == true"
    said = plan(tmp_path, skills, goal, "built-in A*", monkeypatch, "--minimise", "makespan")
    assert last(said) == "2 steps, over after 2.5 s with 3.5 s of work, proved optimal (built-in A*)"


SENSED = """
skill Weigh { in x: Part\n post sensed x.weight > 0 kg\n post x.weighed == true }
impl scale of Weigh { run python "nobody:Needs" }
"""
BY_WEIGHT = BRUSH.format("x.weight / (1 kg) * (1.5 s)")
GUARDED = BY_WEIGHT.replace("post", "pre x has weight\n post")


@pytest.mark.parametrize(
    ("skills", "thing", "expected", "assumed"),
    [
        (GUARDED, "big", "1 step, 3 s expected, proved optimal (built-in A*)", ""),
        (
            f"{BY_WEIGHT}\n{SENSED}",
            "big",
            "1 step, 3 s expected, optimal for approximate durations (built-in A*)",
            "assumed: duration of Brush: reads `lib:weight`, which may change; its value before the plan is taken",
        ),
        (BY_WEIGHT, "light", "1 step, 1 s expected, optimal for approximate durations (built-in A*)", "has no weight"),
    ],
)
def test_a_duration_that_is_not_known_beforehand_claims_nothing(
    skills: str, thing: str, expected: str, assumed: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    said = plan(tmp_path, f"{skills}\n{HAND.format('')}", f"lab:{thing}.clean == true", "built-in A*", monkeypatch)
    assert last(said) == expected
    assert assumed.replace("lib:", "") in said.replace("lib:", "").replace("wash:", "")
    assert ("assumed: " in said) == bool(assumed)


ROUNDS = """
skill Brush { in x: Part\n opt rounds: Int = 2\n post x.clean == true\n duration rounds * 1 s }
impl long of Brush { refine rounds: Int = 5\n pre x has weight\n run python "nobody:Needs" }
impl short of Brush { run python "nobody:Needs" }
"""


@pytest.mark.parametrize(("thing", "seconds"), [("big", 5), ("light", 2)])
def test_a_duration_reads_the_defaults_of_the_implementation_that_is_taken(
    thing: str, seconds: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    said = last(plan(tmp_path, ROUNDS, f"lab:{thing}.clean == true", "built-in A*", monkeypatch))
    assert said == f"1 step, {seconds} s expected, proved optimal (built-in A*)"


LAB = "prefix lab: <http://example.org/lab#>\n"
LIKE = "duration lab:{}.weight / (1 kg) * (1.5 s)\n"


@pytest.mark.parametrize(("thing", "seconds"), [("big", 3.0), ("small", 1.5)])
def test_a_duration_may_name_an_individual(
    thing: str, seconds: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    skills = LAB + BRUSH.format("8 s") + HAND.format(LIKE.format(thing))
    said = last(plan(tmp_path, skills, "lab:light.clean == true", "built-in A*", monkeypatch))
    assert said == f"1 step, {seconds:g} s expected, proved optimal (built-in A*)"


def test_what_is_claimed_names_all_that_it_depends_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    absent = BRUSH.replace("Brush", "Polish").format("1 s") + HAND.replace("Brush", "Polish").format(
        LIKE.format("none")
    )
    skills = "\n".join((LAB, BY_WEIGHT, SENSED, HAND.format(""), absent))
    answer = json.loads(plan(tmp_path, skills, "lab:big.clean == true", "built-in A*", monkeypatch, "--json"))
    assert answer["quality"] == "optimal for the skills that can be planned with and approximate durations"
    assert (answer["optimal"], answer["at_least_s"]) == ("optimal for approximate durations", None)
    assert [each["what"] for each in answer["left_out"] if not each["harmless"]] == [["Polish"]]
    assert answer["assumptions"]


def test_a_skill_of_which_one_action_helps_is_not_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    skills = "\n".join((BRUSH.format("8 s"), HAND.format(""), OWN, WASH.format("1 s")))
    answer = json.loads(plan(tmp_path, skills, "lab:big.clean == true", "built-in A*", monkeypatch, "--json"))
    assert [each["what"] for each in answer["left_out"] if each["kind"] == "skills"] == [["Wash"]]


def test_exact_numbers_come_from_decimals_and_from_what_was_computed_with_them() -> None:
    assert exact_seconds(0.1) == Fraction(1, 10)
    assert exact_seconds(0.1 + 0.2) == Fraction(3, 10)
    assert exact_seconds(10 / 3) == Fraction(10, 3)
    assert exact_seconds(1.00000000000001) == Fraction("1.00000000000001")
    assert exact_seconds(2**0.5) == Fraction(repr(2**0.5)), "nothing is near enough"
    for wrong in (-1.0, float("nan"), float("inf"), True, "1 s"):
        with pytest.raises(ValueError, match="it is"):
            exact_seconds(wrong)


def test_a_scale_makes_durations_whole_where_planners_can_take_them() -> None:
    assert common_scale(map(Fraction, ("0.04", "12", "1/3"))) == 75
    assert common_scale(map(Fraction, ("4e12", "6e12"))) == Fraction(1, 2 * 10**12)
    assert common_scale(()) == common_scale((Fraction(0),)) == 1
    wide = common_scale(map(Fraction, ("1e-9", "1e9")))
    assert wide * 10**9 <= MOST_UNITS
