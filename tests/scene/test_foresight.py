"""What `skillc check` foresees of tasks in their scenes, with the places in both files."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc.services.check import library_checks
from skillc.services.library.files import SHIPPED, find_library
from skillc.services.scaffolding.new_library import create_library
from skillc_dsl.diagnostics import Diagnostic
from skillc_ontology import catalogue

HEAD = """use skiros, skillc, wiping
import "wiping/wipe.skill"
import "gripper.skill"
import "motion.skill"
prefix lab: <http://example.org/lab#>

skill Look {
    in    surface: Surface
    infer what:    Furniture
    infer place:   Workstation
    pre   place contain surface
    pre   place contain what
    noplan
}
impl look of Look { do wait 1 s }

skill Seek {
    in    surface: Surface
    infer what:    Furniture
    pre   surface hasA what
    noplan
}
impl seek of Seek { do wait 1 s }

"""
FORESEEN = {
    "no-implementation-fits",
    "no-answer",
    "several-answers",
    "cannot-start",
    "unreachable-goal",
    "unknown-controller",
}
SUCKER = """
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rparts: <http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#> .
lab:Sucker a owl:Class ; rdfs:subClassOf rparts:GripperEffector .
lab:Sucker-1 a lab:Sucker .
"""
LINE = HEAD.count("\n") + 3


def checked(folder: Path, member: str, more: str = "", controller: str = "impedance") -> list[Diagnostic]:
    """Check a library with one task, whose goal or body is on the line LINE, in a shipped scene with more in it."""
    scene = catalogue.scene_path("iiwa_table").read_text("utf-8").replace('"impedance"', f'"{controller}"')
    (folder / "s.ttl").write_text(scene + more, "utf-8")
    (folder / "t.skill").write_text(f'{HEAD}task t {{\n    scene "s.ttl"\n    {member}\n}}\n', "utf-8")
    found = library_checks.check_library(find_library(folder), None)
    assert not [each for each in found if each.severity == "error" and each.name not in FORESEEN]
    return [each for each in found if each.name in FORESEEN]


def test_a_gripper_that_nobody_can_move_is_told_where_it_is_used(tmp_path: Path) -> None:
    (told,) = checked(tmp_path, "do ActuateGripper(gripper: lab:Sucker-1, opening: 10 mm)", SUCKER)
    assert (told.name, told.severity, told.span.line) == ("no-implementation-fits", "error", LINE)
    assert "lab:Sucker-1 is a lab:Sucker" in told.message
    assert any(label.span.path.endswith("s.ttl") for label in told.labels)


def test_a_gripper_that_nobody_uses_is_told_in_the_scene(tmp_path: Path) -> None:
    (told,) = checked(tmp_path, "do TakePosture(arm: lab:Iiwa-1)", SUCKER)
    assert (told.name, told.severity) == ("no-implementation-fits", "warning")
    assert told.span.path.endswith("s.ttl") and "lab:Sucker-1" in told.message and "WsgGripper" in told.help


def test_an_inferred_parameter_without_answer_is_told(tmp_path: Path) -> None:
    (told,) = checked(tmp_path, "do Seek(surface: lab:Table-1)")
    assert (told.name, told.severity, told.span.line) == ("no-answer", "error", LINE)
    assert "`surface hasA what`" in told.message


def test_an_inferred_parameter_with_several_answers_is_told_with_each_of_them(tmp_path: Path) -> None:
    (told,) = checked(tmp_path, "do Look(surface: lab:Table-1)")
    assert (told.name, told.severity, told.span.line) == ("several-answers", "warning", LINE)
    assert "`what` may be lab:Pedestal, lab:SideTable" in told.message
    assert len([label for label in told.labels if label.span.path.endswith("s.ttl")]) == 2


def test_a_goal_out_of_reach_is_told_with_what_is_missing(tmp_path: Path) -> None:
    (told,) = [d for d in checked(tmp_path, "goal lab:Table-1.isClean == true") if d.severity == "error"]
    assert (told.name, told.span.line) == ("unreachable-goal", LINE - 2)
    assert "Wipe" in told.message


def test_a_thing_of_which_nobody_said_where_it_is_has_the_fact_that_is_missing_as_help(tmp_path: Path) -> None:
    create_library(tmp_path / "cell", "pick-place")
    scene = tmp_path / "cell/cell.ttl"
    text = scene.read_text("utf-8")
    assert text.count("lab:Part-A, lab:Part-B ;") + text.count("lab:Part-A, lab:Part-B .") == 1
    scene.write_text(text.replace("lab:Part-A, lab:Part-B", "lab:Part-A"), "utf-8")
    (told,) = library_checks.check_library(find_library(tmp_path / "cell"), scene)
    assert told.name == "unreachable-goal"
    assert told.help == "state where it is, as of other things: `lab:Cell skiros:contain lab:Part-B`"


def test_what_begins_with_a_call_that_cannot_start_yet_is_a_warning(tmp_path: Path) -> None:
    (told,) = checked(tmp_path, "do Wipe(surface: lab:Table-1)")
    assert (told.name, told.severity, told.span.line) == ("no-answer", "warning", LINE)


@pytest.mark.parametrize(
    ("controller", "help_", "fix"),
    [
        ("impedence", "did you mean `impedance`?", '"impedance"'),
        ("Zed", "`forward_dynamics`, `forward_dynamics_velocity`, `impedance`", None),
    ],
)
def test_a_controller_that_there_is_not_is_told_in_its_line(
    tmp_path: Path, controller: str, help_: str, fix: str | None
) -> None:
    (told,) = checked(tmp_path, "do TakePosture(arm: lab:Iiwa-1)", controller=controller)
    lines = (tmp_path / "s.ttl").read_text("utf-8").split("\n")
    line = lines[told.span.line - 1]
    assert (told.name, told.severity) == ("unknown-controller", "error")
    assert told.span.path.endswith("s.ttl")
    assert line[told.span.column - 1 : told.span.end_column - 1] == f'"{controller}"'
    assert "there are: forward_dynamics, forward_dynamics_velocity, impedance" in told.message and help_ in told.help
    assert (told.fix.text if told.fix else None) == fix


@pytest.mark.parametrize("name", ["wiping", "std"])
def test_nothing_is_foreseen_of_shipped_libraries(name: str) -> None:
    assert library_checks.check_library(find_library(SHIPPED / name), None) == ()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("fact", "wrong", "name"),
    [
        ("skiros:SizeX 0.04 ; skiros:SizeY 0.04", "skiros:SizeX 0.14 ; skiros:SizeY 0.14", "too-wide"),
        ("skiros:Weight 0.15", "skiros:Weight 30.0", "too-heavy"),
    ],
)
def test_what_no_gripper_can_grasp_is_one_error_there_with_the_tasks_that_it_stops(
    tmp_path: Path, fact: str, wrong: str, name: str
) -> None:
    create_library(tmp_path / "cell", "pick-place")
    scene = tmp_path / "cell/cell.ttl"
    text = scene.read_text("utf-8")
    scene.write_text(text.replace(fact, wrong, 1), "utf-8")
    second = '\ntask sort_again {\n    scene "cell.ttl"\n    goal lab:Box-A contain lab:Part-A\n}\n'
    with (tmp_path / "cell/tasks.skill").open("a", encoding="utf-8") as tasks:
        tasks.write(second)
    (told,) = library_checks.check_library(find_library(tmp_path / "cell"), scene)
    assert (told.name, told.severity, Path(told.span.path).name) == (name, "error", "cell.ttl")
    assert [Path(label.span.path).name for label in told.labels] == ["tasks.skill", "tasks.skill"]
    scene.write_text(text, "utf-8")
    assert not library_checks.check_library(find_library(tmp_path / "cell"), scene)
