"""Scenes of other tools, with terms and forms that skillc does not use, are read and go back unharmed."""

from __future__ import annotations

import pytest

from skillc_dsl.source import Source
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


def sensing() -> Vocabulary:
    found = beside(Source("t.ttl", HEAD + SENSING))
    assert found.diagnostics == ()
    return found.value


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
