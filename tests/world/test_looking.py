"""Looking at individuals: terms by name, values with units, where facts come from."""

from __future__ import annotations

import pytest

from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_runtime.world.state.changes import AddRelation, RemoveRelation
from skillc_runtime.world.state.elements import PropertyValue, find_element, find_elements, search_elements
from skillc_runtime.world.state.names import NoSuchName
from skillc_runtime.world.state.provenance import FactSource, Provenance
from skillc_runtime.world.state.world_state import WorldState
from world.lab import SCENE, VOCABULARY, assign, fact, individual, iri


def test_an_element_shows_what_is_known_of_it() -> None:
    box, robot = find_element(SCENE, "t:box"), find_element(SCENE, iri("robot"))
    assert (str(box), box.types, box.is_a("t:Product"), box.is_a("t:Eraser")) == (
        "t:box",
        (iri("Product"),),
        True,
        False,
    )
    assert box.properties == (PropertyValue(iri("label"), ("red", "heavy"), ""), PropertyValue(iri("weight"), 3, "kg"))
    assert str(box.property_value("t:weight")) == "3 kg" and box.property_value("t:label") == box.properties[0]
    assert find_element(SCENE, "t:arm").property_value("t:isClean") is None
    assert str(find_element(SCENE, "t:table").property_value("t:load")) == "1"
    assert [str(each) for each in robot.objects("t:within-it")] == ["t:arm", "t:gripper"]
    assert robot.relations == ((iri("at"), iri("table")), (iri("hasA"), iri("arm")))
    assert [str(each) for each in box.subjects("t:contain")] == ["t:table"]


def names(found: tuple[object, ...]) -> list[str]:
    return list(map(str, found))


def test_individuals_are_found_by_class_relation_and_value() -> None:
    assert names(find_elements(SCENE, "t:Location")) == ["t:shelf", "t:table"]
    assert names(find_elements(SCENE, related={"t:contain": "t:box", "t:beside": "t:shelf"})) == ["t:table"]
    assert names(find_elements(SCENE, "t:Product", having={"t:weight": 3.0})) == ["t:box"]
    assert names(find_elements(SCENE, having={"t:label": "red"})) == ["t:box"]
    assert names(find_elements(SCENE, "t:Location", related={"t:contain": "t:box"}, having={"t:label": "red"})) == []
    assert (
        names(search_elements(SCENE, "HEAVY product")) == ["t:box"] and names(search_elements(SCENE, "heavy arm")) == []
    )


UNKNOWN = [
    (lambda: find_element(SCENE, "t:boxx"), "there is no individual t:boxx; did you mean t:box?"),
    (lambda: find_element(SCENE, "t:qqq"), "there is t:arm, t:board"),
    (lambda: find_elements(SCENE, "t:Locatoin"), "there is no term t:Locatoin; did you mean t:Location?"),
    (lambda: find_elements(SCENE, related={"t:weight": "t:box"}), "t:weight is no relation"),
    (lambda: find_elements(SCENE, having={"t:contain": 3.0}), "t:contain is no property"),
    (lambda: find_element(SCENE, "q:box"), "there is no prefix `q`"),
]


@pytest.mark.parametrize(("look", "words"), UNKNOWN)
def test_names_of_nothing_are_told(look: object, words: str) -> None:
    with pytest.raises(NoSuchName) as caught:
        look()  # type: ignore[operator]
    assert words in str(caught.value)


SHEETS = WorldState.empty(VOCABULARY).with_changes(
    [individual("arm", "Arm"), individual("gripper", "WsgGripper"), fact("arm", "hasGripper", "gripper")]
)
LATER = SCENE.with_changes(
    [fact("table", "contain", "eraser"), assign("box", "weight", 5.0), individual("box", "Eraser")]
)


def test_facts_come_from_sheets_scene_run_or_axioms() -> None:
    contexts = Provenance(SHEETS, SCENE)
    facts = {
        ("arm", "hasGripper", "gripper"): FactSource.ROBOT,
        ("shelf", "beside", "table"): FactSource.SCENE,
        ("table", "beside", "shelf"): FactSource.INFERRED,
        ("table", "contain", "eraser"): FactSource.RUN,
        ("robot", "near", "gripper"): FactSource.INFERRED,
        ("shelf", "contain", "eraser"): None,
    }
    found = {each: contexts.of_relation(LATER, *map(iri, each)) for each in facts}
    assert found == facts
    classes = {"CompliantArm": FactSource.SCENE, "Arm": FactSource.INFERRED, "Product": None}
    assert {each: contexts.of_class(LATER, iri("arm"), iri(each)) for each in classes} == classes
    assert contexts.of_class(LATER, iri("gripper"), iri("WsgGripper")) is FactSource.ROBOT
    assert contexts.of_class(LATER, iri("box"), iri("Eraser")) is FactSource.RUN


def test_every_fact_comes_from_one_place() -> None:
    contexts = Provenance(SHEETS, SCENE)
    by_context = {each: set(contexts.relations(LATER, each)) for each in FactSource}
    expected = {(s, r, o) for r in LATER.facts for s, o in LATER.pairs(r)}
    expected |= {(one, RDF_TYPE, cls) for one, classes in LATER.classes.items() for cls in classes}
    assert all(by_context.values()) and sum(map(len, by_context.values())) == len(expected)
    assert set().union(*by_context.values()) == expected
    assert (iri("table"), iri("contain"), iri("eraser")) in by_context[FactSource.RUN]


def test_a_fact_of_the_scene_that_comes_back_is_one_of_the_scene() -> None:
    gone = SCENE.with_changes([RemoveRelation(iri("table"), iri("contain"), iri("box"))])
    back = gone.with_changes([AddRelation(iri("table"), iri("contain"), iri("box"))])
    contexts, contain = Provenance(SHEETS, SCENE), (iri("table"), iri("contain"), iri("box"))
    assert contexts.of_relation(gone, *contain) is None and contexts.of_relation(back, *contain) is FactSource.SCENE
