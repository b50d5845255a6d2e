"""The skills of a library in the world model: queries find them, and nothing else sees them."""

from __future__ import annotations

import subprocess
import sys
from functools import cache, partial
from pathlib import Path

import msgspec
import pytest

from skillc.cells.snapshot import CellSnapshot, encode_snapshot
from skillc.contract.world import DocumentForm, FactPage, QueryRows
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, find_library
from skillc.workers.answering import answer_work
from skillc.workers.questions import list_facts, query_world, write_world
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.scene.load import load_scene

CHANGES = "SELECT ?text { :Pick skiros:hasPostCondition/skillc:conditionText ?text } ORDER BY ?text"
ABLE = 'SELECT ?robot { ?robot skiros:hasSkill ?skill . ?skill rdfs:label "Drive" }'
SKILLS = "SELECT ?library ?name { GRAPH ?library { ?it a skiros:Skill ; rdfs:label ?name } } ORDER BY ?name"
WHY = """SELECT ?why {
    ?it skillc:rejectedFor lab:Robot-1 ; skillc:rejects :Drive.folded ; skillc:reason ?why
}"""


@cache
def library(name: str) -> SkillLibrary:
    """Compile a shipped library."""
    return compile_valid(find_library(SHIPPED / name))


@cache
def snapshot(name: str) -> bytes:
    """Encode the cell of two robots with a library."""
    state = load_scene(catalogue.scene_path("two_robots"), library(name).vocabulary)
    return encode_snapshot(CellSnapshot(library(name), state, (), 0))


def ask(sparql: str, name: str = "wiping") -> list[tuple[object, ...]]:
    """Return the answer of a worker to a query about the cell."""
    answer = answer_work((partial(query_world, sparql), snapshot(name)))
    assert isinstance(answer, bytes), answer
    return list(msgspec.json.decode(answer, type=QueryRows).rows)


def test_queries_find_what_skills_change_and_which_robots_have_them() -> None:
    assert ask(CHANGES) == [("gripper contain object",), ("not from contain object",)]
    assert ask(ABLE) == [("lab:Heron-1",)]
    assert ask(WHY) == [("`robot` needs a skillc:MobileRobot, and lab:Robot-1 neither is nor has one",)]


def test_rows_are_not_repeated_for_terms_that_the_vocabulary_states_too() -> None:
    assert len(ask("SELECT ?c { cora:Robot rdfs:comment ?c }")) == 1


@pytest.mark.slow
def test_with_another_library_its_skills_are_there_and_no_others() -> None:
    for name in ("wiping", "contact"):
        iri = f"https://w3id.org/skillc/library/{name}"
        assert ask(SKILLS, name) == [(iri, each) for each in sorted(library(name).skills)]
    assert "Wipe" not in library("contact").skills and "Polish" in library("contact").skills


def test_they_are_no_facts_of_the_scene() -> None:
    ask(ABLE)
    facts = answer_work((partial(list_facts, FactPage(limit=1000)), snapshot("wiping")))
    turtle = answer_work((partial(write_world, "cell", DocumentForm("turtle", True)), snapshot("wiping")))
    for answer in (facts, turtle):
        assert isinstance(answer, bytes) and b"Heron-1" in answer
        assert b"hasSkill" not in answer and b"library/wiping" not in answer


@pytest.mark.slow
def test_the_command_and_a_scene_in_python_answer_alike(tmp_path: Path) -> None:
    query = [sys.executable, "-m", "skillc", "world", "two_robots", "--query", ABLE]
    printed = subprocess.run(query, capture_output=True, text=True, cwd=tmp_path, check=True).stdout
    assert printed.split() == ["robot", "lab:Heron-1"]
    import skillc

    with skillc.open_scene("two_robots") as scene:
        assert scene.query(ABLE).rows == (("lab:Heron-1",),)
        assert scene.query("SELECT ?p { lab:Heron-1 ?p :Drive }").rows == ()
