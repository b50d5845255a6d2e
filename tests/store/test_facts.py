"""Facts as triples and changes as text: nothing is lost, whatever is written."""

import os
from random import Random

import msgspec
import numpy as np
import pyoxigraph as ox
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillc_rdf.vocabulary.types import ClassTerm
from skillc_runtime.store.change_json import KINDS, decode_changes, encode_changes
from skillc_runtime.store.triples import all_triples, triple_difference
from skillc_runtime.store.world_from_triples import build_world
from skillc_runtime.world.state.changes import AddIndividual, Change, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import StoreError
from skillc_runtime.world.state.values import are_equal
from skillc_runtime.world.state.world_state import WorldState
from store.worlds import commits, facts_of, filling, random_write
from world.lab import SCENE, VOCABULARY, assign, individual, iri

SEEDS = range(int(os.environ.get("SKILLC_STORE_SEEDS", "20")))


@pytest.mark.parametrize("seed", SEEDS)
def test_a_difference_leads_from_one_version_to_the_next(seed: int) -> None:
    facts, seen = set(all_triples(SCENE)), 0
    for event in commits(WorldModel(SCENE), Random(seed), 25):
        change = triple_difference(event)
        assert facts.issuperset(change.removed) and facts.isdisjoint(change.added)
        facts = facts - set(change.removed) | set(change.added)
        assert facts == set(all_triples(event.after))
        seen += bool(change.removed or change.added)
    assert seen > 10


@pytest.mark.parametrize("seed", SEEDS)
def test_a_world_survives_being_triples(seed: int) -> None:
    *_, last = commits(WorldModel(SCENE), Random(seed), 25)
    again = build_world(all_triples(last.after), VOCABULARY, "it")
    assert facts_of(again) == facts_of(last.after)
    relations = [(r, set(again.pairs(r)), set(last.after.pairs(r))) for r in VOCABULARY.relations]
    assert relations and all(one == other for _, one, other in relations)
    assert again.members.keys() and all(again.instances(c) == last.after.instances(c) for c in VOCABULARY.classes)


@pytest.mark.parametrize("seed", SEEDS)
def test_changes_survive_being_text(seed: int) -> None:
    chance = Random(seed)
    changes = tuple(change for _ in range(20) for change in random_write(chance))
    assert decode_changes(encode_changes(changes)) == changes and "\n" not in encode_changes(changes)
    assert {type(change).__name__ for change in changes} <= KINDS.keys()


@given(st.lists(st.tuples(*[st.floats(allow_nan=False, allow_infinity=False)] * 3), min_size=1))
def test_vectors_survive_being_text(numbers: list[tuple[float, float, float]]) -> None:
    vectors = tuple(map(np.array, numbers))
    for value in (vectors, vectors[0]):
        (again,) = decode_changes(encode_changes((SetProperty("urn:it", "urn:wind", value),)))
        assert isinstance(again, SetProperty) and are_equal(again.value, value)


@pytest.mark.parametrize("text", ["", "[", "{}", "[[]]", '[["Explode"]]', '[["AddRelation","a"]]', "[1]"])
def test_text_that_tells_of_no_changes_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="not changes of a world"):
        decode_changes(text)


def test_classes_and_prefixes_of_a_scene_are_kept_with_its_facts() -> None:
    own = ClassTerm(iri="http://lab/Cup", parents=(iri("Product"),))
    vocabulary = msgspec.structs.replace(
        VOCABULARY, classes={**VOCABULARY.classes, own.iri: own}, prefixes={**VOCABULARY.prefixes, "lab": "http://lab/"}
    )
    state = WorldState.empty(vocabulary).with_changes([AddIndividual("http://lab/cup", (own.iri,))])
    again = build_world(triple_difference(filling(state)).added, VOCABULARY, "it")
    assert again.is_a("http://lab/cup", iri("Product")) and again.vocabulary.short("http://lab/cup") == "lab:cup"


UNFIT = [
    (f"<{iri('box')}> <{iri('unheard')}> <{iri('box')}> .", "there is no relation t:unheard"),
    (f"<{iri('box')}> <{iri('unheard')}> 3 .", "there is no property t:unheard"),
    (f"<{iri('box')}> <{iri('weight')}> 'heavy' .", "t:box.t:weight: it takes a number"),
    (f"<{iri('box')}> <{iri('weight')}> 3 ; <{iri('weight')}> 4 .", "it takes a number"),
    (f"<{iri('box')}> a <{iri('Spaceship')}> .", "no such class"),
    (f"<{iri('box')}> <{iri('containedIn')}> [] .", "there is no individual _:"),
    (f"<{iri('robot')}> <{iri('at')}> <{iri('shelf')}> .", "functional"),
]


@pytest.mark.parametrize(("turtle", "words"), UNFIT)
def test_facts_that_the_vocabulary_forbids_are_told(turtle: str, words: str) -> None:
    extra = [quad.triple for quad in ox.parse(turtle, format=ox.RdfFormat.TURTLE)]
    box = [triple for triple in all_triples(SCENE) if "weight" not in str(triple)]
    with pytest.raises(StoreError) as caught:
        build_world([*box, *extra], VOCABULARY, "the store lab")
    assert "the store lab does not go with these skills" in str(caught.value) and words in str(caught.value)


def test_many_problems_are_counted() -> None:
    extra = [quad.triple for n in range(9) for quad in ox.parse(f"<x:a> <x:p{n}> 1 .", format=ox.RdfFormat.TURTLE)]
    with pytest.raises(StoreError, match="and 4 more"):
        build_world([*all_triples(SCENE), *extra], VOCABULARY, "it")


@pytest.mark.parametrize("change", [individual("a b", "Product"), SetProperty(iri("box"), iri("label"), SCENE)])  # type: ignore[arg-type]
def test_what_no_triple_can_state_is_refused(change: Change) -> None:
    after = SCENE.with_changes([change, assign("box", "weight", 1.0)])
    with pytest.raises(StoreError, match="a store cannot keep"):
        triple_difference(filling(after))
