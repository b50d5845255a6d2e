"""Names of a library of an older edition go before what came later; former names are read."""

from __future__ import annotations

from pathlib import Path

import pytest

from projects.folders import call, checked, names, write_project
from skillc.lsp.libraries import Libraries
from skillc.services.library.files import find_library
from skillc.services.library.libraries import compile_library
from skillc_compiler.goals.parsing import home_of, parse_goal
from skillc_compiler.pipeline import compile
from skillc_compiler.program.name_notes import find_later_names
from skillc_compiler.resolve.files import read_sources
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.editions import EDITIONS, NEWEST
from skillc_dsl.source import Source
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import ClassType, Vocabulary

OWN = """\
use skiros, skillc
import "handling.skill"

class Camera < Product
relation on(Camera, Camera)

skill Locate {
    in   camera: Camera
    in   other:  Camera
    pre  camera on other
    post done: other on camera
    duration 1 s
}

impl plain of Locate { do seq {
    wait 1 s
    apply done
} }
"""
FORMER = """\
use skiros, rparts
import "handling.skill"

skill Bring {
    in    arm:     ArmDevice
    in    object:  Product
    infer gripper: GripperEffector
    infer from:    Location
    pre   arm hasA gripper
    pre   from contain object
    pre   not gripper contain _
    post  gripper contain object
    post  not from contain object
}

impl plain of Bring { do Pick[from_approach](arm, object, gripper, from) }
"""
USER = 'import "older/tasks.skill"\n'


def _compile(folder: Path, edition: int, text: str) -> Outcome[SkillLibrary]:
    project = write_project(folder / f"e{edition}", f'name = "mine"\nedition = {edition}\n', text)
    return compile_library(find_library(project))


def _errors(compiled: Outcome[SkillLibrary]) -> set[str]:
    return {each.name for each in compiled.diagnostics if each.severity == "error"}


def test_own_names_go_before_later_ones(tmp_path: Path) -> None:
    compiled = _compile(tmp_path, 1, OWN)
    assert {each.name for each in compiled.diagnostics} <= {"unused-import"}
    assert {"Locate", "std_Locate", "Pick"} <= compiled.value.skills.keys()
    camera = compiled.value.skills["Locate"].parameters[0].type
    assert camera == ClassType("https://w3id.org/skillc/library/mine#Camera")
    calls = repr([each.body for each in compiled.value.implementations.values()])
    assert "Call(skill='std_Locate'" in calls and "Call(skill='Locate'" not in calls


@pytest.mark.parametrize("edition", EDITIONS)
def test_a_class_goes_before_a_later_dimension(tmp_path: Path, edition: int) -> None:
    text = OWN.replace("class Camera", "class Power < Product\nclass Camera").replace("other:  Camera", "other:  Power")
    text = text.replace("relation on(Camera, Camera)", "relation on(Camera, Power)\nrelation on(Power, Camera)")
    compiled = _compile(tmp_path, edition, text.replace("Locate", "Look").replace(" on", " beside"))
    assert _errors(compiled) == set()
    other = compiled.value.skills["Look"].parameters[1].type
    assert other == ClassType("https://w3id.org/skillc/library/mine#Power")


def test_in_the_edition_with_which_they_came_they_mean_the_shipped_ones(tmp_path: Path) -> None:
    found = {each.name for each in _compile(tmp_path, 2, OWN).diagnostics}
    assert {"duplicate-declaration", "redeclared-term"} <= found


def test_a_former_name_is_read_up_to_its_edition(tmp_path: Path) -> None:
    first = _compile(tmp_path, 1, FORMER)
    assert _errors(first) == set()
    called = first.value.implementations["Bring.plain"].body
    assert "from_above" in repr(called) and "from_approach" not in repr(called)
    (problem,) = [each for each in _compile(tmp_path, 2, FORMER).diagnostics if each.severity == "error"]
    assert problem.name == "unknown-implementation" and problem.help == "write `from_above`"


def test_each_library_has_its_own_edition(tmp_path: Path) -> None:
    write_project(tmp_path / "older", 'name = "older"\n', FORMER)
    user = 'name = "mine"\nedition = 2\n[dependencies]\nolder = { path = "../older" }\n'
    project = write_project(tmp_path / "mine", user, USER + FORMER.replace("Bring", "Fetch"))
    assert names(checked(project)) == [("unknown-implementation", 17)]


@pytest.mark.parametrize(("edition", "words"), [("3", "there are 1 and 2"), ("0", "there are 1 and 2")])
def test_an_unknown_edition_is_told_with_those_that_exist(edition: str, words: str, tmp_path: Path) -> None:
    (found,) = checked(write_project(tmp_path / "x", f'name = "mine"\nedition = {edition}\n'))
    assert (found["name"], found["line"]) == ("wrong-setting", 2) and words in found["message"]


def test_a_change_of_the_edition_alone_is_seen_in_spite_of_caches(tmp_path: Path) -> None:
    project = write_project(tmp_path / "x", 'name = "mine"\n', FORMER)
    assert call(project, "check").exit_code == 0
    (project / "skillc.toml").write_text('name = "mine"\nedition = 2\n', "utf-8")
    assert call(project, "check").exit_code == 1


def test_what_came_later_is_of_an_edition_that_exists() -> None:
    shipped = find_library(Path("std"))
    files = read_sources(shipped.sources, shipped.importable, shipped.name).value
    later = {name: since for unit in files for name, since in find_later_names(unit).items()}
    assert {"Locate", "Weigh", "carried", "grasp_pose"} <= later.keys()
    assert set(later.values()) <= set(EDITIONS[1:])


def test_a_term_that_a_row_gives_a_later_edition_gives_way_before(tmp_path: Path) -> None:
    row = "<https://example.org/later> skillc:edition 2 ; skillc:adds skiros:Container ."
    prefixes = """\
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
"""
    texts = [Source(path, text) for path, text in catalogue.vocabulary_files()]
    vocabulary = load([*texts, Source("rows.ttl", f"{prefixes}{row}\n")]).value
    found = [
        compile([Source("a.skill", "use skiros\nclass Container < Product\n", edition=edition)], vocabulary, {}, "mine")
        for edition in EDITIONS
    ]
    own = "https://w3id.org/skillc/library/mine#Container"
    assert [own in each.value.vocabulary.classes for each in found] == [True, False]
    assert ["redeclared-term" in {problem.name for problem in each.diagnostics} for each in found] == [False, True]


def test_a_skill_that_a_row_gives_a_later_edition_gives_way_before() -> None:
    skill = "skill Shake {{  {0}\n    noplan\n}}\n"
    user = 'import "shaking.skill"\n' + skill.format("")
    shipped = {"shaking.skill": Source("std/shaking.skill", skill.format("# since edition 2"))}
    found = [
        compile([Source("a.skill", user, edition=edition)], Vocabulary(), shipped, "mine").diagnostics
        for edition in EDITIONS
    ]
    assert ["duplicate-declaration" in {problem.name for problem in each} for each in found] == [False, True]


def test_the_editor_reads_a_library_in_its_edition(tmp_path: Path) -> None:
    text = f"use skiros, rparts, skillc\n{OWN.partition(chr(10))[2]}relation start(Camera, Camera)\n"
    for edition in EDITIONS:
        file = write_project(tmp_path / str(edition), f'name = "mine"\nedition = {edition}\n', text) / "tasks.skill"
        libraries = Libraries((file.parent,))
        libraries.write(file.as_uri(), file.read_text("utf-8"))
        told = {each.name for each in libraries.view(file.as_uri()).analysis.problems}
        assert ("duplicate-declaration" in told) == (edition == NEWEST)
        libraries.write(file.as_uri(), text.replace("duration 1 s", "duration 2 s"))
        assert {each.name for each in libraries.view(file.as_uri()).analysis.problems} == told


CLEANING = """\
use skiros

function depth(p: Product) -> Length = python "skillc.space:depth"

skill Clean {
    in   object: Product
    opt  depth:  Length = 1 cm
    # former thing until edition 1: write `object`
    noplan
}
impl plain of Clean { run python "skillc.primitives:StandIn" }

# former Cleanse until edition 1: write `Clean`
# former deepness until edition 1: write `depth`
"""
CLEANED = """\
use skiros
import "cleaning.skill"

skill Twice {
    in thing: Product
    noplan
}
impl first of Twice {
    do seq {
        Cleanse(thing)
        Cleanse(thing: thing, depth: deepness(thing))
    }
}
impl other of Cleanse { run python "skillc.primitives:StandIn" }
"""


def test_former_skills_functions_and_parameters_are_read_up_to_their_edition() -> None:
    vocabulary = load([Source(path, text) for path, text in catalogue.vocabulary_files()]).value
    importable = {"cleaning.skill": Source("std/cleaning.skill", CLEANING)}
    found = [
        compile([Source("a.skill", CLEANED, edition=edition)], vocabulary, importable, "mine") for edition in EDITIONS
    ]
    unknown = [{each.name for each in one.diagnostics if each.name.startswith("unknown")} for one in found]
    assert unknown == [set(), {"unknown-skill", "unknown-function"}]
    assert {"Clean.other", "Twice.first"} <= found[0].value.implementations.keys()
    body = repr(found[0].value.implementations["Twice.first"].body)
    assert body.count("skill='Clean'") == 2 and body.count("'object': Variable(name='thing')") == 2
    assert "Invoke(function='depth'" in body


def test_a_goal_is_read_in_the_edition_in_which_it_is_right(tmp_path: Path) -> None:
    compiled = _compile(tmp_path, 1, "use skiros\nclass Cup < Product\nrelation start(Cup, Cup)\n").value
    prefixes = {**compiled.vocabulary.prefixes, "lab": "http://example.org/lab#"}
    cups = {f"http://example.org/lab#{name}": ("https://w3id.org/skillc/library/mine#Cup",) for name in ("A", "B")}
    goal = parse_goal("lab:A start lab:B", compiled.vocabulary, cups, prefixes, home_of(compiled), compiled.skills)
    assert [each.name for each in goal.diagnostics if each.severity == "error"] == []
