"""Scenes of other tools, with terms and forms that skillc does not use, are read and go back unharmed."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pyoxigraph as ox
import pytest
from click.testing import CliRunner
from rdflib import Graph

from skillc.cli.main import skillc
from skillc.services.scene.editing import edit_file
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.terms import with_named
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import load_sheets, read_documents, sheet_documents
from skillc_runtime.scene.saving import format_scene
from vocabularies.reading import HEAD, T, beside

SENSING = """<http://example.org/t> a owl:Ontology .
t:Sample a owl:Class ; rdfs:subClassOf sumo:Object . t:Act a owl:Class .
t:taken a owl:DatatypeProperty, owl:FunctionalProperty ; rdfs:domain t:Sample ; rdfs:range xsd:dateTime .
t:due a owl:DatatypeProperty ; rdfs:range xsd:date .
t:result a owl:DatatypeProperty .
t:of a owl:ObjectProperty ; rdfs:range t:Sample .
"""


@cache
def sensing() -> Vocabulary:
    found = beside(Source("t.ttl", HEAD + SENSING))
    assert found.diagnostics == ()
    return with_named(found.value, found.value.idle)


def test_dates_are_read_and_written() -> None:
    taken, due = '"2026-11-29T08:30:00+01:00"^^xsd:dateTime', '"2026-12-01"^^xsd:date, "2027-01-01"'
    said = f"t:S a t:Sample ; t:taken {taken} ; t:due {due} ."
    document = Document("scene.ttl", HEAD + said)
    scene = read_documents([document, *sheet_documents()], sensing())
    assert scene.problems == ()
    assert scene.state.value(f"{T}S", f"{T}taken") == "2026-11-29T08:30:00+01:00"
    saved = format_scene(scene.state, load_sheets(sensing()), document)
    assert '"2026-11-29T08:30:00+01:00"^^<http://www.w3.org/2001/XMLSchema#dateTime>' in saved
    again = read_documents([Document("saved.ttl", saved), *sheet_documents()], sensing())
    assert again.problems == () and again.state.value(f"{T}S", f"{T}due") == ("2026-12-01", "2027-01-01")


@pytest.mark.parametrize("text", ["yesterday", "2026-02-30T00:00:00"])
def test_what_is_no_date_is_an_error(text: str) -> None:
    document = Document("scene.ttl", f'{HEAD}t:S a t:Sample ; t:taken "{text}"^^xsd:dateTime .')
    problems = read_documents([document, *sheet_documents()], sensing()).problems
    assert [(each.name, each.severity) for each in problems] == [("wrong-data-type", "error")]


PLACE = "t:S a t:Sample .\n"
KEPT = {
    "an undeclared property": ('t:S t:tint "red" .', "`t:tint` (1)"),
    "an undeclared relation": ("t:S t:beside t:Other . t:Other a t:Sample .", "`t:beside` (1)"),
    "undeclared terms of another vocabulary": (
        "@prefix geo: <http://example.org/geo#> . t:S geo:lat 57.0 ; geo:long 10.0 .",
        "`geo:lat` (1), `geo:long` (1)",
    ),
    "a thing without a name": ('t:A a t:Act ; t:of [ a t:Sample ; t:due "2026-12-01" ] .', "things without a name (3)"),
    "a thing without a name or class": ("t:A a t:Act ; t:of [] .", "things without a name (1)"),
    "an individual of another vocabulary": ("t:A a t:Act ; t:of <http://example.org/units/M> .", "units/M` (1)"),
    "a list": ("t:A a t:Act ; t:of ( t:S ) .", "things without a name (3)"),
    "a structure below an undeclared property": (
        "t:S t:standing [ t:x 1 ; t:y [ t:z 2 ] ] .",
        "things without a name (4)",
    ),
    "a thing of an undeclared class": (
        't:B a t:Bread ; t:due "2026-12-01" . t:A a t:Act ; t:of t:B .',
        "`t:Bread` (3)",
    ),
    "an undeclared class beside another": ("t:S a t:Bread .", "`t:Bread` (1)"),
    "a number of a property without a range": ("t:S t:result 33 .", "`t:result` (1)"),
    "a value of a datatype of its own": ('t:S t:result "47 km/h"^^t:speed .', "`t:result` (1)"),
    "a frame without a name": ('t:S skiros:BaseFrameId "" .', "`skiros:BaseFrameId` (1)"),
}


def triples(text: str) -> int:
    return len(set(map(str, ox.parse(text, ox.RdfFormat.TURTLE))))


@pytest.mark.parametrize("kind", KEPT)
def test_what_is_not_understood_is_listed_once_and_kept(kind: str) -> None:
    said, listed = KEPT[kind]
    document = Document("scene.ttl", HEAD + PLACE + said)
    scene = read_documents([document, *sheet_documents()], sensing())
    assert [(each.name, each.severity) for each in scene.problems] == [("not-understood", "warning")]
    assert listed in scene.problems[0].message and scene.problems[0].span.path == "scene.ttl"
    assert f"{T}S" in scene.state.individuals and f"{T}B" not in scene.state.individuals
    saved = format_scene(scene.state, load_sheets(sensing()), document)
    assert triples(saved) == triples(document.text)
    again = read_documents([Document("scene.ttl", saved), *sheet_documents()], sensing())
    assert [each.message for each in again.problems] == [each.message for each in scene.problems]


@pytest.mark.parametrize("kind", KEPT)
def test_an_edit_leaves_what_is_not_understood_as_it_is(kind: str, tmp_path: Path) -> None:
    text = f"{HEAD}# a remark\n{PLACE}{KEPT[kind][0]}\n"
    file = tmp_path / "scene.ttl"
    file.write_text(text, "utf-8")
    state = read_documents([Document.read(file), *sheet_documents()], sensing()).state
    edit_file(file, state, ['t:S.due == "2027-01-01"', 'not t:S.due == "2027-01-01"', "t:N is t:Act"])
    edited = file.read_text("utf-8")
    assert [line for line in edited.split("\n") if line not in text] == ["t:N a t:Act ."]
    assert all(line in edited for line in text.split("\n"))


@pytest.mark.parametrize(
    ("said", "name"),
    [
        ("t:Board a t:Sample . t:A a t:Act ; t:of t:Bord .", "unknown-individual"),
        ("t:A a t:Act ; t:of <http://example.org/tt#S> .", "unknown-individual"),
        ('t:S t:deu "2026-12-01" .', "unknown-property"),
        ("t:A a t:Act ; t:fo t:S .", "unknown-relation"),
        ("t:B a t:Sampel .", "unknown-class"),
        ('t:S <http://example.org/tt#due> "2026-12-01" .', "unknown-property"),
    ],
)
def test_a_name_that_is_probably_misspelt_is_an_error(said: str, name: str) -> None:
    document = Document("scene.ttl", HEAD + PLACE + said)
    errors = [
        each for each in read_documents([document, *sheet_documents()], sensing()).problems if each.severity == "error"
    ]
    assert [each.name for each in errors] == [name] and "did you mean" in errors[0].help


def test_what_is_stated_is_not_missed_and_frames_are_checked_beside_what_is_not_understood() -> None:
    needed = "[ a owl:Restriction ; owl:onProperty t:of ; owl:someValuesFrom t:Sample ]"
    others = beside(Source("t.ttl", f"{HEAD}{SENSING}t:Act rdfs:subClassOf {needed} .")).value
    terms = with_named(others, [f"{T}of"])
    said = f't:A a t:Act ; t:of [ a t:Sample ] . t:B a t:Act . {PLACE} t:S skiros:BaseFrameId "nowhere" .'
    problems = read_documents([Document("scene.ttl", HEAD + said), *sheet_documents()], terms).problems
    found = [(each.name, each.message.partition(" ")[0]) for each in problems if each.severity == "error"]
    assert ("missing-property", "t:B") in found and ("missing-property", "t:A") not in found
    said = said.replace("t:B a t:Act .", "")
    problems = read_documents([Document("scene.ttl", HEAD + said), *sheet_documents()], terms).problems
    assert {"not-understood", "unknown-frame"} <= {each.name for each in problems}


NEEDING = """t:near a owl:ObjectProperty . t:touches a owl:ObjectProperty ; rdfs:subPropertyOf t:near .
t:Act rdfs:subClassOf [ a owl:Restriction ; owl:onProperty t:of ; owl:someValuesFrom t:Sample ],
    [ a owl:Restriction ; owl:onProperty t:touches ; owl:minCardinality 1 ] .
"""


@pytest.mark.parametrize(
    ("named", "lacking"),
    [((), ()), (("of",), ("t:of",)), (("near",), ("t:touches",)), (("of", "touches"), ("t:of", "t:touches"))],
)
def test_a_required_value_is_an_error_only_if_a_skill_reads_it(
    named: tuple[str, ...], lacking: tuple[str, ...]
) -> None:
    others = beside(Source("t.ttl", HEAD + SENSING + NEEDING)).value
    terms = with_named(others, [T + name for name in named])
    acts = " ".join(f"t:A{number} a t:Act ." for number in range(5))
    problems = read_documents([Document("scene.ttl", HEAD + acts), *sheet_documents()], terms).problems
    assert {each.name for each in problems} == {"missing-property"}
    errors = [each.message for each in problems if each.severity == "error"]
    assert len(errors) == (5 if lacking else 0) and all(f"has no {', '.join(lacking)}," in each for each in errors)
    (warned,) = [each.message for each in problems if each.severity == "warning"] or [""]
    left = sorted({"t:of", "t:touches"} - set(lacking))
    assert bool(warned) == bool(left)
    assert not left or warned == f"t:A0, t:A1, t:A2 and 2 more lack what their classes require: {', '.join(left)}"


UNFIT = """t:A a t:Act ; t:of t:Free . t:Free a skiros:Product . t:S a t:Sample ; t:taken "soon", "later" .
t:Free t:due "2026-12-01"^^xsd:date ; t:taken "2026-11-29T08:30:00Z"^^xsd:dateTime . t:A t:of t:Gone, t:Gone2 .
"""


def test_what_contradicts_terms_that_no_skill_reads_is_kept_with_one_warning() -> None:
    idle = beside(Source("t.ttl", HEAD + SENSING)).value
    document = Document("scene.ttl", HEAD + UNFIT)
    scene = read_documents([document, *sheet_documents()], idle)
    assert scene.ok and [each.name for each in scene.problems] == ["not-understood"]
    (warned,) = scene.problems
    assert "6 statements of terms that no skill reads contradict the ontology" in warned.message
    assert "`t:of` (3)" in warned.message and "`t:taken` (3)" in warned.message
    assert scene.state.value(f"{T}Free", f"{T}due") == ("2026-12-01",)
    saved = format_scene(scene.state, load_sheets(idle), document)
    assert Graph().parse(data=saved, format="turtle").isomorphic(Graph().parse(data=HEAD + UNFIT, format="turtle"))


def test_the_same_is_an_error_where_a_skill_reads_it() -> None:
    idle = beside(Source("t.ttl", HEAD + SENSING)).value
    document = Document("scene.ttl", HEAD + UNFIT)
    scene = read_documents([document, *sheet_documents()], with_named(idle, [f"{T}taken"]))
    errors = [each for each in scene.problems if each.severity == "error"]
    assert {each.name for each in errors} >= {"wrong-data-type", "property-domain"}
    assert not any("t:of" in each.message for each in errors)


UNITS = """<http://example.org/t> a owl:Ontology . t:Unit a owl:Class . t:Metre a t:Unit . t:Inch a t:Unit .
t:Length a owl:Class . t:in a owl:ObjectProperty ; rdfs:domain t:Length ; rdfs:range t:Unit .
"""


def test_individuals_of_ontologies_that_a_scene_mentions_are_in_its_world() -> None:
    units = beside(Source("t.ttl", HEAD + UNITS))
    assert units.diagnostics == () and units.value.individuals.keys() == {f"{T}Metre", f"{T}Inch"}
    document = Document("scene.ttl", f"{HEAD}@prefix l: <http://e/l#> . l:Rod a t:Length ; t:in t:Metre .")
    scene = read_documents([document, *sheet_documents()], units.value)
    assert scene.problems == ()
    state = scene.state
    assert state.types(f"{T}Metre") == {f"{T}Unit"} and f"{T}Inch" not in state.individuals
    assert state.holds("http://e/l#Rod", f"{T}in", f"{T}Metre")


def test_an_individual_of_an_ontology_where_it_does_not_fit_is_an_error_at_the_scene(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("own").mkdir()
    Path("own/units.ttl").write_text(HEAD + UNITS, "utf-8")
    said = f"{HEAD}@prefix l: <http://e/l#> .\nl:Bin a skiros:Container ; skiros:contain t:Metre .\n"
    Path("scene.ttl").write_text(said, "utf-8")
    result = CliRunner().invoke(skillc, ["world", "scene.ttl", "--ontology", "own"])
    assert result.exit_code == 1 and "relation-range" in result.stderr
    assert re.search(r"-> scene.ttl:\d+:\d+", result.stderr) and "ontologies:" not in result.stderr


SKIROS_CELL = """@prefix cora: <http://www.inf.ufrgs.br/phi-group/ontologies/cora.owl#> .
@prefix demo: <http://example.org/demo#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix rparts: <http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .

demo:Approach a owl:class ; rdfs:subClassOf skiros:Skill .
demo:Scene-0 a skiros:Scene ; skiros:FrameId "world"^^xsd:string ; skiros:BaseFrameId ""^^xsd:string ;
    skiros:PositionX "0.0"^^xsd:float ; skiros:PositionY "0.0"^^xsd:float ; skiros:PositionZ "0.0"^^xsd:float ;
    skiros:contain cora:Robot-1, demo:Box-4, demo:Pose-5, rparts:ArmDevice-2 .
cora:Robot-1 a cora:Robot, owl:NamedIndividual ; skiros:FrameId "cora:Robot-1" ; skiros:BaseFrameId "" ;
    skiros:hasA rparts:ArmDevice-2 ; skiros:SkillMgr "demo" ; skiros:hasSkill demo:Approach-1 .
demo:Approach-1 a demo:Approach, owl:NamedIndividual .
rparts:ArmDevice-2 a rparts:ArmDevice, owl:NamedIndividual ; skiros:BaseFrameId "cora:Robot-1" ;
    skiros:CartesianGoalAction "/iiwa/goal" ; skiros:CartesianStiffnessTopic "/iiwa/stiffness" .
demo:Box-4 a skiros:Container ; skiros:FrameId "demo:Box-4" ; skiros:BaseFrameId "world" ; skiros:TfTimeStamp 0.0 ;
    skiros:PositionX "0.5"^^xsd:float ; skiros:PositionY "0.0"^^xsd:float ; skiros:PositionZ "0.05"^^xsd:float ;
    skiros:OrientationX 0.0 ; skiros:OrientationY -1.0 ; skiros:OrientationZ 0.0 ; skiros:OrientationW 0.0 .
demo:Pose-5 a skiros:ObservationPose ; skiros:BaseFrameId "demo:Box-4" ; skiros:FrameId "demo:Pose-5" ;
    skiros:PositionX "0.0"^^xsd:float ; skiros:PositionY "0.0"^^xsd:float ; skiros:PositionZ "-0.4"^^xsd:float .
"""
"""A cell as SkiROS2 saves it: the root frame has no base, the arm has topics, and neither a pose nor a data sheet."""
LOOKING = """use skiros, rparts, cora, skillc
import "motion.skill"

skill Look {
    in   arm: ArmDevice
    in   at:  ObservationPose
    pre  exists robot: Robot (robot hasA arm)
    noplan
}

impl tool_down of Look { do MoveTo(arm, target: at.pose) }
"""
LOOK = "Look(arm: rparts:ArmDevice-2, at: demo:Pose-5)"
OF_THE_ARM = (
    "is Iiwa14",
    "skillc:hasSheet skillc:iiwa14-sheet",
    'skiros:CompliantController "impedance"',
    'skiros:FrameId "iiwa_base"',
    *(f"skiros:Position{axis} 0.0" for axis in "XYZ"),
)
"""What a SkiROS2 scene does not say of its arm, and a run needs."""


@pytest.mark.slow
def test_a_robot_cell_of_skiros2_runs_once_its_arm_is_known(tmp_path: Path) -> None:
    scene = tmp_path / "cell.ttl"
    scene.write_text(SKIROS_CELL, "utf-8")
    (tmp_path / "look.skill").write_text(LOOKING, "utf-8")
    edits = [f"rparts:ArmDevice-2 {each}" for each in OF_THE_ARM]
    library = ("--library", str(tmp_path))

    half = CliRunner().invoke(skillc, ["scene", "edit", str(scene), *library, *edits[:3]])
    assert half.exit_code == 1 and "unchanged, because the scene would have errors" in half.stderr
    assert "skiros:PositionX" in half.stderr and "hasSheet" not in half.stderr
    assert scene.read_text("utf-8") == SKIROS_CELL
    whole = CliRunner().invoke(skillc, ["scene", "edit", str(scene), *library, *edits])
    assert whole.exit_code == 0, whole.output
    before, after = (Graph().parse(data=text) for text in (SKIROS_CELL, scene.read_text("utf-8")))
    assert not set(before) - set(after) and len(set(after) - set(before)) == len(edits)

    call = ["run", *library, "--scene", str(scene), "--backend", "kinematic", "--call", LOOK, "--tick-timeout", "0"]
    ran = CliRunner().invoke(skillc, call)
    assert ran.exit_code == 0 and "Look  succeeded" in ran.stdout, ran.output
