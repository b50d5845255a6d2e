"""`skillc world --export`: what is exported and loaded again has the same facts, whoever reads it."""

from __future__ import annotations

import json
from pathlib import Path

import pyoxigraph as ox
import pytest
from click.testing import CliRunner
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rdflib import Graph
from rdflib.compare import isomorphic

from skillc.cli.main import skillc
from skillc.services.library import libraries
from skillc.services.views.scene_export import world_graph
from skillc_ontology import catalogue
from skillc_rdf.formats.write import UnwritableError, format_as
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import load_documents, load_scene, sheet_documents
from skillc_runtime.scene.saving import format_scene
from skillc_runtime.store.triples import all_triples
from skillc_runtime.world.state.world_state import WorldState

FORMATS = {"turtle": "turtle", "rdfxml": "xml", "jsonld": "json-ld", "ntriples": "nt", "trig": "trig"}
"""The formats, and how rdflib names them."""
HEAD = "@prefix lab: <http://example.org/lab#> .\n@prefix skillc: <https://w3id.org/skillc/core#> .\n"
HEAD += "@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .\n"

texts = st.text(st.characters(codec="utf-8", exclude_categories=("Cc", "Cs")), max_size=12)
numbers = st.one_of(st.integers(1, 10**6).map(float), st.floats(1e-300, 1e300))


@st.composite
def scenes(draw: st.DrawFn) -> str:
    """Return a scene with things that have texts, numbers and relations."""
    names = draw(st.lists(st.from_regex(r"[A-Za-z][\w-]{0,5}", fullmatch=True), min_size=1, max_size=4, unique=True))
    blocks = []
    for name in (f"<http://example.org/lab#{each}>" for each in names):
        number, text = draw(numbers), draw(texts)
        facts = f"skiros:Weight {number!r}{'e0' * ('e' not in repr(number))}"
        blocks.append(f"{name} a skiros:Product ; {facts} ; skiros:FrameId {ox.Literal(name + text)} .\n")
    return HEAD + "".join(blocks)


def load(text: str, suffix: str = "") -> WorldState:
    return load_documents([Document.of(f"scene{suffix}", text), *sheet_documents()], libraries.load_vocabulary())


@pytest.mark.slow
@given(scenes())
@settings(max_examples=5, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_random_scenes_are_the_same_after_each_format(text: str) -> None:
    state = load(text)
    turtle = format_scene(state, WorldState.empty(libraries.load_vocabulary()))
    expected = set(all_triples(state))
    for form in FORMATS:
        assert set(all_triples(load(format_as(form, turtle)))) == expected, form


@pytest.mark.slow
@pytest.mark.parametrize("form", FORMATS)
def test_other_tools_read_what_is_exported(form: str, tmp_path: Path) -> None:
    result = CliRunner().invoke(skillc, ["world", "iiwa_table", "--export", form])
    assert result.exit_code == 0, result.output
    stated = load_scene(catalogue.scene_path("iiwa_table"), libraries.load_vocabulary())
    graph = Graph().parse(data=result.stdout, format=FORMATS[form])
    assert isomorphic(
        graph, world_graph(stated, libraries.load_vocabulary(), Document.read(catalogue.scene_path("iiwa_table")))
    )
    formats = {"turtle": "TURTLE", "rdfxml": "RDF_XML", "jsonld": "JSON_LD", "ntriples": "N_TRIPLES", "trig": "TRIG"}
    assert len(set(ox.parse(result.stdout, getattr(ox.RdfFormat, formats[form])))) == len(graph) > 50
    again = CliRunner().invoke(skillc, ["world", "iiwa_table", "--export", form])
    assert again.stdout == result.stdout


def test_a_store_is_exported_with_what_happened_in_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    stored = CliRunner().invoke(
        skillc, ["world", "iiwa_table", "--store", "s", "--export", "jsonld", "-o", "new/x.jsonld"]
    )
    assert (stored.exit_code, stored.stdout) == (0, "new/x.jsonld\n"), stored.output
    assert "lab" in json.loads(Path("new/x.jsonld").read_text())["@context"]
    same = CliRunner().invoke(skillc, ["world", "new/x.jsonld", "--diff", "iiwa_table"])
    assert same.stdout == "no differences\n"


def test_with_all_the_data_sheets_are_exported_too() -> None:
    some, every = (
        CliRunner().invoke(skillc, ["world", "iiwa_table", "--export", "ntriples", *more]).stdout
        for more in ((), ("--all",))
    )
    sheet = "<https://w3id.org/skillc/core#robotiq-3f-sheet>"
    assert len(every.splitlines()) > 2 * len(some.splitlines())
    assert not any(line.startswith(sheet) for line in some.splitlines())


def test_what_xml_cannot_state_is_a_sentence() -> None:
    with pytest.raises(UnwritableError, match="RDF/XML cannot state <http://e/1/>: its IRI does not end with a name"):
        format_as("rdfxml", "<http://e/a> <http://e/1/> <http://e/b> .")
    with pytest.raises(UnwritableError, match="it has a control character"):
        format_as("rdfxml", '<http://e/a> <http://e/b> "a\\u0001" .')


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("--export", "jsonld", "--search", "x"), "cannot be combined"),
        (("-o", "x"), "--output requires --export FORMAT"),
        (("--export", "n3"), "'n3' is not one of"),
        (("--export", "trig", "-o", "/proc/x/y"), "/proc/x/y cannot be written"),
    ],
)
def test_wrong_options_are_sentences(options: tuple[str, ...], sentence: str) -> None:
    result = CliRunner().invoke(skillc, ["world", "iiwa_table", *options])
    assert result.exit_code in (1, 2) and sentence in result.stderr
