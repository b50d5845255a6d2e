"""Every fact of a scene is read as an edit in the syntax in which it is shown; people can state what is listed."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_scene
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.scene.stores import load_world
from skillc.services.scene.world_edits import read_edits
from skillc.services.tasks.listing import default_library
from skillc.workers.terms import list_terms
from skillc_runtime.world.state.changes import AddRelation, SetProperty
from skillc_runtime.world.state.elements import elements_of
from skillc_runtime.world.state.facts import PropertyFact, RelationFact
from skillc_runtime.world.state.labels.labelled_text import format_fact
from skillc_runtime.world.state.labels.labelling import label_fact
from skillc_runtime.world.state.world_state import WorldState


@pytest.fixture(scope="module")
def state() -> WorldState:
    vocabulary = compile_valid(default_library()).vocabulary
    scene = find_scene(Path("ur5e_whiteboard"))
    assert scene is not None
    return load_world(scene, vocabulary, SilentReporter())


def test_each_fact_is_read_as_it_is_shown(state: WorldState) -> None:
    relations, values = 0, 0
    for each in elements_of(state, state.individuals):
        for relation, object_ in each.relations:
            shown = format_fact(label_fact(RelationFact(each.iri, relation, object_), state))
            assert read_edits([shown], state) == (AddRelation(each.iri, relation, object_),)
            relations += 1
        for stated in each.properties:
            fact = PropertyFact(each.iri, stated.property)
            shown = format_fact(label_fact(fact, state))
            (change,) = read_edits([shown], state)
            assert isinstance(change, SetProperty)
            assert (change.individual, change.property) == (each.iri, stated.property)
            assert shown == format_fact(label_fact(fact, state.with_changes([change])))
            values += 1
    assert relations > 10 and values > 100


def test_all_that_is_stated_can_be_stated(state: WorldState) -> None:
    terms = 0
    for each in elements_of(state, state.individuals):
        listed = list_terms(state.vocabulary.short(each.iri), state, frozenset())
        known = {term.iri for term in listed.terms}
        stated = {relation for relation, _ in each.relations} | {value.property for value in each.properties}
        assert stated <= known | state.vocabulary.deprecated.keys(), each
        assert all(cls in listed.things for term in listed.terms for cls in term.objects)
        terms += len(stated)
    assert terms > 100
