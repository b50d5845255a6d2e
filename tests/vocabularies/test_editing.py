"""Edits of Turtle texts change what they say and nothing else: not a comment, not the layout of what stays."""

from __future__ import annotations

import os
import random

import pyoxigraph as ox
import pytest

from skillc_ontology import catalogue
from skillc_rdf.turtle.editing import Editor, StatementNotFound
from skillc_rdf.turtle.parser import parse
from skillc_rdf.turtle.statements import Node
from skillc_rdf.turtle.terms import RDF_TYPE, XSD

BASE = "file:///scene"
E = "http://e/#"
HEAD = "@prefix e: <http://e/#> .\n"
RUNS = int(os.environ.get("SKILLC_EDITS", "8"))


def editor(text: str) -> Editor:
    return Editor(HEAD + text, BASE, lambda iri: iri)


def node(name: str) -> ox.NamedNode:
    return ox.NamedNode(E + name)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("e:a e:p e:b, e:o, e:c . # x\n", "e:a e:p e:b, e:c . # x\n"),
        ("e:a e:p e:o, e:c .\n", "e:a e:p e:c .\n"),
        ("e:a e:p e:b, e:o .\n", "e:a e:p e:b .\n"),
        ("e:a a e:C ; # its class\n    e:p e:o ; # gone\n    e:q 1 .\n", "e:a a e:C ; # its class\n    e:q 1 .\n"),
        ("e:a a e:C ;\n    e:p e:o .\n", "e:a a e:C .\n"),
        ("e:a e:p e:o ; e:q 1 .\n", "e:a e:q 1 .\n"),
        ("e:a a e:C ; e:p e:o ; .\n", "e:a a e:C ;  .\n"),
        ("# before\ne:a e:p e:o .\n# behind\n", "# before\n# behind\n"),
        ("e:a e:p e:o . e:b e:p e:o .\n", " e:b e:p e:o .\n"),
    ],
)
def test_a_statement_is_taken_away(before: str, after: str) -> None:
    text = editor(before)
    text.remove(f"{E}a", f"{E}p", node("o"))
    assert text.text == HEAD + after


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("e:a a e:C . # x\n", "e:a a e:C ;\n    e:p e:o . # x\n"),
        ("e:a a e:C ;\n    e:q 1 . # one\n", "e:a a e:C ;\n    e:p e:o ;\n    e:q 1 . # one\n"),
        ("e:a e:p [ e:q ( 1 2 ) ] .\n", "e:a e:p [ e:q ( 1 2 ) ], e:o .\n"),
        ("e:b a e:C .", "e:b a e:C .\n\ne:a e:p e:o .\n"),
        ("e:a e:p e:o .\n", "e:a e:p e:o .\n"),
    ],
)
def test_a_statement_is_added(before: str, after: str) -> None:
    text = editor(before)
    text.add(f"{E}a", f"{E}p", node("o"))
    assert text.text == HEAD + after


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("e:a e:p 1.0 ; e:q 2 .\n", "e:a e:p 2.5 ; e:q 2 .\n"),
        ("e:a e:p 1, 2 .\n", "e:a e:p 2.5 .\n"),
        ("e:a e:p 1 . e:a e:p 2 .\n", "e:a e:p 2.5 . \n"),
        ("e:a e:q 1 .\n", "e:a e:p 2.5 ;\n    e:q 1 .\n"),
    ],
)
def test_a_value_is_set(before: str, after: str) -> None:
    text = editor(before)
    text.set(f"{E}a", f"{E}p", ox.Literal("2.5", datatype=ox.NamedNode(f"{XSD}decimal")))
    assert text.text == HEAD + after


def test_everything_about_an_individual_is_taken_away() -> None:
    text = editor("e:a a e:C ; e:p e:b .\ne:b a e:C ;\n    e:p e:c, e:a .\ne:d e:p e:b . # last\n")
    text.forget(f"{E}b")
    assert text.text == HEAD + "e:a a e:C .\n # last\n"
    with pytest.raises(StatementNotFound):
        text.forget(f"{E}b")
    with pytest.raises(StatementNotFound):
        text.remove(f"{E}a", f"{E}p", node("b"))


@pytest.mark.parametrize("seed", range(RUNS))
def test_random_edits_of_shipped_scenes_say_what_they_should(seed: int) -> None:
    dice = random.Random(seed)
    scene = catalogue.scene_path(dice.choice(catalogue.scene_names())).read_text("utf-8")
    text = Editor(scene, BASE, lambda iri: iri)
    comments = scene.count("# ---")
    for _ in range(6):
        said = triples(text.text)
        subject, predicate, object_ = dice.choice(sorted(said, key=str))
        match dice.randrange(4):
            case 0:
                text.remove(subject, predicate, object_)
                assert triples(text.text) == said - {(subject, predicate, object_)}
            case 1:
                new: Node = ox.Literal(f'a "text" {seed}')
                text.add(subject, predicate, new)
                assert triples(text.text) == said | {(subject, predicate, new)}
            case 2:
                text.set(subject, predicate, node("value"))
                others = {each for each in said if each[:2] != (subject, predicate)}
                assert triples(text.text) == others | {(subject, predicate, node("value"))}
            case _:
                text.add(f"{E}new", RDF_TYPE, node("C"))
                assert triples(text.text) == said | {(f"{E}new", RDF_TYPE, node("C"))}
    assert text.text.count("# ---") == comments


def triples(text: str) -> frozenset[tuple[str, str, Node]]:
    parsed = parse("scene", text, BASE)
    assert parsed.problems == ()
    return frozenset((str(each.subject.value), each.predicate, each.object) for each in parsed.statements)
