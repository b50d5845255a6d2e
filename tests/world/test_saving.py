"""A saved scene is the world: no fact is lost, and a file is whole or as it was."""

from __future__ import annotations

import os
from pathlib import Path
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc.services.library import libraries
from skillc_ontology import catalogue
from skillc_runtime.scene import saving
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import load_documents, load_in_bulk, load_scene, load_sheets
from skillc_runtime.scene.saving import SaveError, format_scene, save_scene
from skillc_runtime.world.state.changes import AddIndividual
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState
from store.worlds import commits, facts_of
from world.lab import SCENE, VOCABULARY, assign, individual, iri
from world.sameness import everything

EMPTY = WorldState.empty(VOCABULARY)
SEEDS = range(int(os.environ.get("WORLD_SEEDS", "15")))


def again(state: WorldState, source: str | None = None) -> WorldState:
    """Save a world and load it."""
    text = format_scene(state, EMPTY, None if source is None else Document("source.ttl", source))
    return load_documents([Document("saved.ttl", text)], VOCABULARY)


@pytest.mark.parametrize("seed", SEEDS)
def test_no_fact_is_lost(seed: int) -> None:
    *_, last = commits(WorldModel(SCENE), Random(seed), 25)
    found = again(last.after)
    assert facts_of(found) == facts_of(last.after)
    relations = [(r, set(found.pairs(r)), set(last.after.pairs(r))) for r in VOCABULARY.relations]
    assert relations and all(one == other for _, one, other in relations)
    assert format_scene(found, EMPTY) == format_scene(last.after, EMPTY)


@settings(max_examples=int(os.environ.get("SAVED_VALUES", "30")))
@given(st.floats(allow_nan=False, allow_infinity=False), st.lists(st.text(st.characters(exclude_categories=["Cs"]))))
def test_no_number_or_text_is_changed(number: float, texts: list[str]) -> None:
    labels = tuple(dict.fromkeys(texts)) or ("none",)
    state = SCENE.with_changes([assign("box", "weight", number), assign("box", "label", labels)])
    found = again(state)
    assert repr(found.value(iri("box"), iri("weight"))) == repr(number)
    assert sorted(found.value(iri("box"), iri("label"))) == sorted(labels)  # type: ignore[arg-type]


@pytest.mark.slow
@pytest.mark.parametrize("name", catalogue.scene_names())
def test_shipped_scenes_come_back_with_labels_and_without_data_sheets(name: str) -> None:
    vocabulary = libraries.load_vocabulary()
    state, sheets = load_scene(catalogue.scene_path(name), vocabulary), load_sheets(vocabulary)
    source = Document.read(catalogue.scene_path(name))
    text = format_scene(state, sheets, source)
    found = load_in_bulk([Document("s", text), *(Document(*each) for each in catalogue.vocabulary_files())], vocabulary)
    assert found is not None and everything(found) == everything(state)
    assert text.count("rdfs:label") == source.text.count("rdfs:label") > 0
    assert "JointValues" not in text and format_scene(found, sheets, Document("s", text)) == text


SOURCE = """@prefix t: <http://example.org/test#> . @prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix l: <http://lab#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> . @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
t:Mug a owl:Class ; rdfs:subClassOf t:Product ; rdfs:label "mug"@en .
l:cup a t:Mug, owl:NamedIndividual ; t:weight 0.3 ; rdfs:label "Jo's cup"@de ; rdfs:seeAlso [ rdfs:label "a shop" ] .
l:old a t:Mug ; rdfs:label "broken" . l:pattern a skiros:Template, t:Mug ; t:weight 0.2 . # a comment
"""


def test_what_a_scene_says_beside_its_facts_is_kept_without_what_is_gone() -> None:
    model = WorldModel(load_documents([Document("source.ttl", SOURCE)], VOCABULARY))
    with model.transaction() as now:
        now.remove("l:old")
        now.set("l:cup", "t:weight", 0.25)
    text = format_scene(model.snapshot(), EMPTY, Document("source.ttl", SOURCE))
    found = load_documents([Document("saved.ttl", text)], VOCABULARY)
    assert everything(found) | {"vocabulary": 0} == everything(model.snapshot()) | {"vocabulary": 0}
    assert found.is_a("http://lab#cup", iri("Product"))
    for kept in ('"mug"@en', "Jo's cup", "a shop", "skiros:Template", "owl:NamedIndividual", "2.0e-1"):
        assert kept.replace("2.0e-1", '"0.2"') in text, text
    for gone in ("l:old", "broken", "a comment", "0.3"):
        assert gone not in text


def test_a_file_is_replaced_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "scene.ttl"
    save_scene(SCENE, path, EMPTY)
    written = path.read_text("utf-8")
    assert facts_of(load_documents([Document.read(path)], VOCABULARY)) == facts_of(SCENE)

    def full(_file: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(saving.os, "fsync", full)
    with pytest.raises(OSError, match="No space"):
        save_scene(EMPTY.with_changes([individual("box", "Product")]), path, EMPTY)
    assert path.read_text("utf-8") == written and list(tmp_path.iterdir()) == [path]


def test_what_no_scene_can_say_is_refused() -> None:
    with pytest.raises(SaveError, match="it is not an IRI"):
        format_scene(SCENE.with_changes([AddIndividual("a b", (iri("Product"),))]), EMPTY)
    with pytest.raises(SaveError, match="nan is not a number"):
        format_scene(SCENE.with_changes([assign("box", "weight", float("nan"))]), EMPTY)
    with pytest.raises(SaveError, match="cannot retract facts of data sheets"):
        format_scene(SCENE.with_changes([assign("box", "weight", 1.0)]), SCENE)
