"""Individuals made of templates, and templates that make no sense."""

from __future__ import annotations

import pytest

from skillc_runtime.scene.documents import Document, SceneError
from skillc_runtime.scene.load import load_documents
from skillc_runtime.scene.templates import read_templates
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.names import NoSuchName
from skillc_runtime.world.state.templates import Templates
from world.lab import NS, VOCABULARY, iri

HEAD = f"""@prefix t: <{NS}> . @prefix lab: <http://lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
"""
SCENE = """lab:shelf a t:Location . lab:other a t:Location .
lab:Crate a skiros:Template, t:Product, t:Holder ; t:weight 2.5 ; t:label "red", "big" ; rdfs:label "crates" .
lab:Robot a skiros:Template, t:Robot ; t:at lab:shelf ; t:hasA lab:Arm .
lab:Arm a skiros:Template, t:CompliantArm ; t:state "Idle" ; t:near lab:Robot .
"""


def read(text: str) -> tuple[WorldModel, Templates]:
    documents = [Document("scene.ttl", HEAD + text)]
    model = WorldModel(load_documents(documents, VOCABULARY))
    return model, read_templates(documents, model.snapshot().vocabulary)


def test_what_a_template_says_is_true_of_what_is_made_of_it() -> None:
    model, templates = read(SCENE)
    with model.transaction() as now:
        made = [now.instantiate(templates, "lab:Crate", f"lab:crate-{n}") for n in (1, 2)]
        now.relate("lab:shelf", "t:contain", "lab:crate-1")
    state = model.snapshot()
    assert [state.value(each, iri("weight")) for each in made] == [2.5, 2.5]
    assert [state.types(each) for each in made] == [{iri("Product"), iri("Holder")}] * 2
    assert state.value(made[0], iri("label")) == ("red", "big")
    assert state.individuals == {"http://lab#shelf", "http://lab#other", *made}


def test_templates_that_refer_to_each_other_are_made_together() -> None:
    model, templates = read(SCENE)
    with model.transaction() as now:
        robot = now.instantiate(templates, "lab:Robot", "lab:robot-1")
        now.instantiate(templates, "lab:Robot", "lab:robot-2")
    state = model.snapshot()
    assert state.objects(robot, iri("at")) == {"http://lab#shelf"}
    assert state.objects(robot, iri("hasA")) == {f"{robot}-Arm"}
    assert state.holds(f"{robot}-Arm", iri("near"), robot) and len(state.instances(iri("Arm"))) == 2


def test_an_individual_is_not_made_twice_and_axioms_hold() -> None:
    model, templates = read(SCENE)
    with pytest.raises(ValueError, match="there is a lab:shelf already"), model.transaction() as now:
        now.instantiate(templates, "lab:Crate", "lab:shelf")
    with pytest.raises(NoSuchName, match="no template lab:Box; there is lab:Arm, lab:Crate, lab:Robot"):
        templates.instance("lab:Box", "http://lab#box", model.snapshot())
    with pytest.raises(WorldError, match="no individual lab:shelf"), model.transaction() as now:
        now.remove("lab:shelf")
        now.instantiate(templates, "lab:Robot", "lab:robot-1")


BAD = [
    ("lab:T a skiros:Template ; t:weight 3 .", "lab:T has no class"),
    ("lab:T a skiros:Template, t:Product ; t:wieght 3 .", "there is no property t:wieght"),
    ('lab:T a skiros:Template, t:Product ; t:weight "3 kg" .', "t:weight: it takes a number"),
    ("lab:T a skiros:Template, t:Spaceship .", "there is no class t:Spaceship"),
    ("lab:T a skiros:Template, t:Holder ; t:contain lab:nobody .", "there is no individual lab:nobody"),
    ("lab:T a skiros:Template, t:Product ; t:weight 3, 4 .", "two values of t:weight"),
    ("lab:T a skiros:Template", "a `.` is missing"),
]


@pytest.mark.parametrize(("text", "words"), BAD)
def test_a_template_that_makes_no_sense_is_told(text: str, words: str) -> None:
    with pytest.raises(SceneError) as caught:
        read_templates([Document("scene.ttl", HEAD + text)], VOCABULARY)
    assert any(words in problem.message for problem in caught.value.problems)
    assert all(problem.span.line == HEAD.count("\n") + 1 for problem in caught.value.problems)
