"""Scenes and ontologies in each RDF format: the same facts, problems at their subjects, nothing from the network."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner
from rdflib import Dataset, Graph, URIRef

from skillc.cli.main import skillc
from skillc.services.library import libraries
from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_rdf.formats.detect import UnsupportedFormat, detect_format
from skillc_rdf.vocabulary.load import load
from skillc_runtime.scene.documents import SceneError
from skillc_runtime.scene.load import load_scene, read_scene
from skillc_runtime.store.triples import all_triples
from waiting import LONG_S

SCENE = catalogue.scene_path("ur5e_whiteboard")
FORMATS = {"xml": ".owl", "pretty-xml": ".rdf", "json-ld": ".jsonld", "nt": ".ttl", "trig": ".x", "nquads": ".y"}
"""How rdflib names the formats, and suffixes that partly say something else: the content counts."""
HEAD = "@prefix lab: <http://example.org/lab#> .\n@prefix skillc: <https://w3id.org/skillc/core#> .\n"


def write(form: str, folder: Path, turtle: str) -> Path:
    """Write a Turtle text in another format; where there are graphs, half of the facts are in a named one."""
    graph = Graph().parse(data=turtle, format="turtle", publicID="file:///scene")
    path = folder / f"scene{FORMATS[form]}"
    if form in ("trig", "nquads"):
        dataset = Dataset()
        for prefix, base in graph.namespaces():
            dataset.bind(prefix, base)
        for number, triple in enumerate(sorted(graph)):
            (dataset.graph(URIRef("http://e/g")) if number % 2 else dataset.default_graph).add(triple)
        dataset.serialize(path, format=form, encoding="utf-8")
    elif form == "json-ld":
        graph.serialize(path, format=form, encoding="utf-8", context=dict(graph.namespaces()))
    else:
        graph.serialize(path, format=form, encoding="utf-8")
    return path


@pytest.mark.parametrize("form", FORMATS)
def test_a_scene_has_the_same_facts_in_each_format(form: str, tmp_path: Path) -> None:
    vocabulary = libraries.load_vocabulary()
    facts = set(all_triples(load_scene(SCENE, vocabulary)))
    assert len(facts) > 100
    assert set(all_triples(load_scene(write(form, tmp_path, SCENE.read_text()), vocabulary))) == facts


@pytest.mark.parametrize("form", [form for form in FORMATS if form != "nt"])
def test_a_problem_names_its_subject_and_is_where_the_file_is_about_it(form: str, tmp_path: Path) -> None:
    turtle = HEAD + "lab:A a skillc:Workstation ; skillc:hasSheet lab:B .\nlab:B a skillc:Shelff ."
    path = write(form, tmp_path, turtle)
    (problem,) = read_scene(path, libraries.load_vocabulary()).problems
    line = path.read_text().splitlines()[problem.span.line - 1][problem.span.column - 1 :]
    assert problem.name == "unknown-class" and problem.fix is None
    assert problem.message in (
        f"{name}: there is no class skillc:Shelff" for name in ("lab:B", "http://example.org/lab#B")
    )
    assert "B" in line or line.startswith("<rdf:Description")


def test_a_problem_in_json_is_where_an_object_is_not_where_a_reference_is(tmp_path: Path) -> None:
    path = tmp_path / "scene.json"
    path.write_text(
        '{"@context": {"lab": "http://example.org/lab#", "skillc": "https://w3id.org/skillc/core#", "id": "@id"},\n'
        '"@graph": [{"id": "lab:A", "@type": "skillc:Workstation", "skillc:hasSheet": {"id": "lab:B"}},\n'
        '{"id": "lab:B", "@type": "skillc:Shelff"}]}'
    )
    (problem,) = read_scene(path, libraries.load_vocabulary()).problems
    assert (problem.span.line, problem.span.column, problem.span.end_column) == (3, 8, 15)


UNREADABLE = {
    "HTML": ("<!DOCTYPE html><html></html>", "this file is HTML"),
    "entities that expand": (
        '<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa">'
        + "".join(f'<!ENTITY b{n} "{(f"&b{n - 1};" if n else "&a;") * 10}">' for n in range(10))
        + "]><x:x>&b9;</x:x>",
        "limit on input amplification factor",
    ),
    "an entity elsewhere": (
        '<!DOCTYPE x [<!ENTITY other SYSTEM "file:///etc/hostname">]><x:x>&other;</x:x>',
        "the entity `other` is in another file, which is not read",
    ),
    "deep elements": ("<rdf:RDF>" + "<x:y>" * 100_000, "nested too deeply"),
    "deep JSON": ('{"@id":"http://e/a","http://e/p":' * 20_000, "nested too deeply"),
    "rather deep JSON": ('{"http://e/p":' * 300 + "1" + "}" * 300, "nested too deeply"),
    "broken JSON": ('{"@id": "http://e/a",\n "http://e/p" 1}', "this file is not JSON: Expecting ':' delimiter"),
    "a remote context": (
        '{"@context": "https://schema.org/", "@id": "http://e/a"}',
        "the context <https://schema.org/>",
    ),
    "an imported context": (
        '{"@context": [{"@import": "http://127.0.0.1:9/c"}]}',
        "the context <http://127.0.0.1:9/c>",
    ),
    "a huge text": ('{"@id":"http://e/a","http://e/p":"' + "x" * 17_000_000 + '"}', "longer than 16 MB"),
    "half a file": ('<?xml version="1.0"?>\n<rdf:RDF>', "this file is not RDF/XML: no element found"),
}


@pytest.mark.parametrize("kind", UNREADABLE)
def test_what_cannot_be_read_is_one_sentence_for_scenes_and_ontologies(kind: str, tmp_path: Path) -> None:
    text, sentence = UNREADABLE[kind]
    (tmp_path / "scene.ttl").write_text(text)
    with pytest.raises(SceneError) as caught:
        load_scene(tmp_path / "scene.ttl", libraries.load_vocabulary())
    (problem,) = caught.value.problems
    assert sentence in problem.message and problem.help and problem.name == "unreadable-scene"
    (same,) = load((), [Source("terms.owl", text)]).diagnostics
    assert (same.message, same.span.line) == (problem.message, problem.span.line)


def test_files_may_begin_with_a_mark_and_name_an_encoding_that_does_not_matter(tmp_path: Path) -> None:
    body = '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"><rdf:Description rdf:about="&l;A">{}'
    body += '<rdf:type rdf:resource="https://w3id.org/skillc/core#Workstation"/></rdf:Description></rdf:RDF>'
    head = "<?xml version='1.0' encoding='{}'?><!DOCTYPE x [<!ENTITY l 'http://example.org/lab#'>]>"
    label = '<label xmlns="http://www.w3.org/2000/01/rdf-schema#" xml:lang="de">{}</label>'
    path = tmp_path / "scene.rdf"
    for text in (
        "\ufeff" + head.format("UTF-8") + body.format(label.format("Tür")),
        head.format("ISO-8859-1") + body.format(label.format("door")),
    ):
        path.write_text(text, "utf-8")
        assert load_scene(path, libraries.load_vocabulary()).exists("http://example.org/lab#A")
    path.write_text(head.format("ISO-8859-1") + body.format(label.format("Tür")), "latin-1")
    with pytest.raises(SceneError, match="it is not UTF-8 text"):
        load_scene(path, libraries.load_vocabulary())


def test_braces_in_texts_and_comments_are_no_graphs() -> None:
    for text, form in (
        ("# { }\n<x:a> <x:b> ' { } ' .", "Turtle"),
        ("<x:g> { <x:a> <x:b> <x:c> }", "TriG"),
        ("<x:a> <x:b> <x:c> <x:g> .\n", "N-Quads"),
        ("<x:a> <x:b> <x:c> .\n<x:d> <x:e> <x:f> .", "Turtle"),
        ("<x:a> { <x:b> <x:c> .", "Turtle"),
        ("[ a <x:b> ] .", "Turtle"),
        ("[]", "JSON-LD"),
    ):
        found = detect_format(Source("scene", text))
        assert not isinstance(found, UnsupportedFormat) and found.name == form, text


def test_json_is_read_without_rdflib(tmp_path: Path) -> None:
    path = write("json-ld", tmp_path, SCENE.read_text())
    program = (
        "import sys, pathlib\nfrom skillc.services.library import libraries\n"
        "from skillc_runtime.scene.load import load_scene\n"
        f"load_scene(pathlib.Path({str(path)!r}), libraries.load_vocabulary())\nassert 'rdflib' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program], check=True, timeout=LONG_S)


def test_a_scene_that_is_not_turtle_is_used_by_tasks_and_not_edited(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    run = CliRunner().invoke
    path = write("json-ld", tmp_path, SCENE.read_text())
    (tmp_path / "own.skill").write_text(
        "use skiros, skillc, wiping\nprefix lab: <http://example.org/lab#>\n\n"
        f'task t {{\n    scene "{path.name}"\n    goal lab:Whiteboard-1.isClean == true\n}}\n'
    )
    checked = run(skillc, ["check", "."])
    assert checked.exit_code == 0, checked.output
    edited = run(skillc, ["scene", "edit", path.name, "lab:Dock skiros:FrameId 'x'"])
    assert edited.exit_code == 1
    assert (
        "only Turtle can be edited; convert it first: `skillc world scene.jsonld --export turtle -o scene.ttl`"
        in edited.stderr
    )


def test_data_sheets_of_an_ontology_folder_may_be_in_another_format(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sheet = HEAD + "skillc:my-sheet a skillc:ArmSheet .\n"
    (tmp_path / "robots").mkdir()
    write("xml", tmp_path / "robots", sheet)
    monkeypatch.setenv(catalogue.VARIABLE, str(tmp_path))
    assert any("my-sheet" in text for _, text in catalogue.sheet_files())
