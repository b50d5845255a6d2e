"""The OWL output: readable, consistent, and of use to a reasoner."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import msgspec
import owlrl
import pytest
from hypothesis import given
from hypothesis import strategies as st
from rdflib import OWL, RDF, RDFS, XSD, Graph, Literal, Namespace, URIRef

from accept import built, cases
from emit.samples import BASE, WIPE, holds, implementation, library, need, wiping
from skillc_compiler.emit import owl
from skillc_compiler.emit.owl.turtle import IriNode, format_turtle
from skillc_model.skills import Requirement, SkillLibrary

SAMPLE = Namespace("https://w3id.org/skillc/library/sample#")
SKILLC = Namespace("https://w3id.org/skillc/core#")
SKIROS = Namespace("http://rvmi.aau.dk/ontologies/skiros.owl#")
CSS = Namespace("http://www.w3id.org/hsu-aut/css#")
CORE = Namespace(BASE)
ERRORS = URIRef("http://www.daml.org/2002/03/agents/agent-ont#error")


def graph(made: SkillLibrary) -> Graph:
    return Graph().parse(data=owl.emit(made)["skills.ttl"], format="turtle")


def two_ways(*own: Requirement) -> SkillLibrary:
    skill = msgspec.structs.replace(WIPE, implementations=("careful", "plain"))
    careful = implementation(skill, "careful", *own, arm="CompliantArm")
    return library(skill, implementations=(careful, implementation(skill, "plain")))


def invocation(arm_class: URIRef) -> Graph:
    """Return the library with a call of Wipe whose arm is of the class, and everything that follows."""
    made = graph(two_ways())
    call, wipe = SAMPLE["call"], SAMPLE["some-wipe"]
    made.add((call, RDF.type, SKILLC.Invocation))
    made.add((call, SKILLC.invokes, wipe))
    made.add((wipe, RDF.type, SAMPLE["Wipe"]))
    for parameter in WIPE.parameters:
        thing = SAMPLE[f"the-{parameter.name}"]
        made.add((call, SAMPLE[f"Wipe.argument.{parameter.name}"], thing))
        made.add((thing, RDF.type, URIRef(parameter.type.iri)))  # type: ignore[union-attr]
    made.add((SAMPLE["the-arm"], RDF.type, arm_class))
    owlrl.DeductiveClosure(owlrl.OWLRL_Semantics).expand(made)
    return made


def test_a_description_has_its_parameters_and_conditions() -> None:
    made = graph(wiping())
    pick = SAMPLE["Pick"]
    assert (pick, RDF.type, OWL.Class) in made
    assert {str(made.value(each, RDFS.label)) for each in made.objects(pick, SKIROS.hasParam)} == {
        "arm", "object", "robot", "gripper", "from", "limit",
    }  # fmt: skip
    empty = SAMPLE["Pick.pre.empty"]
    assert (pick, SKIROS.hasPreCondition, empty) in made
    assert made.value(empty, SKILLC.desiredState) == Literal(False)
    assert made.value(empty, SKILLC.subject) == SAMPLE["Pick.parameter.gripper"]
    assert made.value(empty, SKILLC.conditionRelation) == CORE["contain"]
    ready = SAMPLE["Pick.hold.ready"]
    assert (made.value(ready, SKILLC.operator), made.value(ready, SKILLC.comparedValue)) == (
        Literal("!="),
        Literal("Fault"),
    )


def test_values_are_typed_and_types_are_things() -> None:
    made = graph(wiping())
    limit, arm = SAMPLE["Pick.parameter.limit"], SAMPLE["Pick.parameter.arm"]
    assert made.value(limit, SKILLC.defaultValue) == Literal(2.0, datatype=XSD.double)
    assert (made.value(limit, SKILLC.parameterType), made.value(limit, SKILLC.unit)) == (SKILLC.Mass, Literal("kg"))
    assert (SKILLC.Mass, RDF.type, SKILLC.Dimension) in made
    assert made.value(arm, SKILLC.parameterType) == CORE["Arm"]
    pick = SAMPLE["Pick"]
    assert made.value(pick, SKILLC.duration) == Literal(15.0, datatype=XSD.double)
    assert made.value(pick, SKILLC.durationUnit) == Literal("s")
    assert made.value(pick, SKILLC.pause) == Literal("between steps")
    assert made.value(pick, SKILLC.keep) == Literal(0.5, datatype=XSD.double)
    assert made.value(pick, SKILLC.keepUnit) == Literal("s")
    assert {word for word in made.predicates(SAMPLE["Wipe"]) if word in (SKILLC.pause, SKILLC.keep)} == set()


@pytest.mark.parametrize("name", [case.name for case in cases()])
def test_every_parameter_type_is_a_named_thing_and_no_namespace_has_two_prefixes(name: str) -> None:
    text = built(Path(__file__).parents[1] / "cases/build" / name)["skills.ttl"]
    types = list(Graph().parse(data=text, format="turtle").objects(None, SKILLC.parameterType))
    assert types and all(isinstance(each, URIRef) for each in types)
    spaces = [line.split()[2] for line in text.splitlines() if line.startswith("@prefix")]
    assert len(spaces) == len(set(spaces))


def test_a_library_with_terms_of_its_own_has_one_prefix_for_them() -> None:
    made = wiping()
    words = msgspec.structs.replace(made.vocabulary, prefixes={"core": BASE, "sample": str(SAMPLE)})
    text = owl.emit(msgspec.structs.replace(made, vocabulary=words))["skills.ttl"]
    assert text.count(f"<{SAMPLE}>") == 1


def test_it_agrees_with_the_axioms_of_capabilities_and_skills() -> None:
    """The axioms are of https://github.com/CaSkade-Automation/CSS, version 3.0.0, services left out."""
    made = graph(two_ways(need("free", holds("gripper contain tool"))))
    assert (SAMPLE["Wipe"], CSS.isRestrictedBy, SAMPLE["Wipe.pre.on"]) in made
    for skill, capability in list(made.subject_objects(SKILLC.implements)):
        made.add((capability, CSS.isRealizedBySkill, skill))
    for relation, domain, range_ in (
        (CSS.isRealizedBySkill, CSS.Capability, CSS.Skill),
        (CSS.isRestrictedBy, CSS.Capability, CSS.Constraint),
    ):
        made.add((relation, RDFS.domain, domain))
        made.add((relation, RDFS.range, range_))
    kinds = (CSS.Capability, CSS.Skill, CSS.SkillParameter)
    for one, other in (*combinations(kinds, 2), (CSS.Constraint, CSS.Skill), (CSS.Constraint, CSS.SkillParameter)):
        made.add((one, OWL.disjointWith, other))
    owlrl.DeductiveClosure(owlrl.OWLRL_Semantics).expand(made)
    assert (SAMPLE["Wipe"], RDF.type, CSS.Capability) in made
    assert (SAMPLE["Wipe.careful"], RDF.type, CSS.Skill) in made
    assert not list(made.subject_objects(ERRORS))


def test_an_invocation_is_an_instance_of_the_implementations_that_fit_it() -> None:
    compliant, stiff = invocation(CORE["CompliantArm"]), invocation(CORE["Arm"])
    careful, plain = SAMPLE["Wipe.careful"], SAMPLE["Wipe.plain"]
    assert (SAMPLE["call"], RDF.type, careful) in compliant
    assert (SAMPLE["call"], RDF.type, plain) in compliant
    assert (SAMPLE["call"], RDF.type, careful) not in stiff
    assert (SAMPLE["call"], RDF.type, plain) in stiff
    assert not list(compliant.subject_objects(ERRORS))


def test_blank_nodes_occur_only_in_class_expressions() -> None:
    made = graph(wiping())
    blank = {each for each in made.subjects() if not isinstance(each, URIRef)}
    assert blank
    for each in blank:
        kind = made.value(each, RDF.type)
        assert kind in (OWL.Class, OWL.Restriction, RDFS.Datatype) or made.value(each, RDF.first) is not None


locals_ = st.from_regex(r"[A-Za-zä_.0-9-]{1,8}", fullmatch=True)
values = st.text() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False)


@pytest.mark.slow
@given(st.lists(st.tuples(locals_, values), max_size=6))
def test_what_is_written_is_read_back(pairs: list[tuple[str, str | bool | int | float]]) -> None:
    base = "http://example.org/x#"
    text = format_turtle({"x": base}, [(base + name, base + "value", value) for name, value in pairs])
    read = {(str(subject), type(value.value), value.value) for subject, _, value in Graph().parse(data=text)}
    assert read == {(base + name, type(value), value) for name, value in pairs}


def test_the_order_of_statements_does_not_matter() -> None:
    made = [(f"http://x/{a}", f"http://y/{b}", IriNode(f"http://z/{c}")) for a in "ab" for b in "ab" for c in "ab"]
    assert format_turtle({}, made) == format_turtle({}, reversed(made)) == format_turtle({}, [*made, *made])
