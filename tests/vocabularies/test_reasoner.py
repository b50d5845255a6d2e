"""What is told to be impossible is what a reasoner for OWL 2 DL finds to be, in generated vocabularies."""

from __future__ import annotations

import os
import random
from collections.abc import Iterator

import pytest

from emit.reasoner import classified, needs_java
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.contradictions import find_unsatisfiable
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.reading import read_ontologies

VOCABULARIES = int(os.environ.get("SKILLC_VOCABULARIES", "15"))
AT_ONCE = 100
"""How many the reasoner is given together: it takes longer to start than to find."""
CLASSES, RELATIONS = 8, 5
NOTHING = "http://www.w3.org/2002/07/owl#Nothing"
HEAD = """@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
"""

pytestmark = [needs_java, pytest.mark.reasoner]


def generated(number: int, single: bool) -> Iterator[str]:
    """Yield the lines of a vocabulary; with `single`, relations may be functional and classes unions."""
    dice, base = random.Random(number), f"http://example.org/g{number}"
    yield f"@prefix g: <{base}#> . <{base}> a owl:Ontology ."
    for one in range(CLASSES):
        yield f"g:C{one} a owl:Class ."
        for other in dice.sample(range(one), min(one, dice.choice((0, 1, 1, 2)))):
            yield f"g:C{one} rdfs:subClassOf g:C{other} ."
        if dice.random() < 0.35:
            yield f"g:C{one} owl:disjointWith g:C{dice.choice([each for each in range(CLASSES) if each != one])} ."
        if dice.random() < 0.4:
            need = f"owl:onProperty g:r{dice.randrange(RELATIONS)} ; owl:someValuesFrom g:C{dice.randrange(CLASSES)}"
            yield f"g:C{one} rdfs:subClassOf [ a owl:Restriction ; {need} ] ."
    if single:
        members = " ".join(f"g:C{each}" for each in dice.sample(range(CLASSES), 2))
        yield f"g:U a owl:Class ; owl:equivalentClass [ a owl:Class ; owl:unionOf ( {members} ) ] ."
    for one in range(RELATIONS):
        yield from relation(dice, one, single)


def relation(dice: random.Random, one: int, single: bool) -> Iterator[str]:
    yield f"g:r{one} a owl:ObjectProperty ."
    need = f"[ a owl:Restriction ; owl:onProperty g:r{one} ; owl:someValuesFrom owl:Thing ]"
    yield f"g:Some{one} a owl:Class ; rdfs:subClassOf {need} ."
    kinds = ("Symmetric", "Asymmetric", "Irreflexive", *(("Functional", "InverseFunctional") if single else ()))
    yield from (f"g:r{one} a owl:{kind}Property ." for kind in kinds if dice.random() < 0.2)
    for predicate in ("rdfs:domain", "rdfs:range"):
        if dice.random() < 0.5:
            yield f"g:r{one} {predicate} {end(dice, single)} ."
    if one and dice.random() < 0.4:
        yield f"g:r{one} {dice.choice(('rdfs:subPropertyOf', 'owl:inverseOf'))} g:r{dice.randrange(one)} ."


def end(dice: random.Random, single: bool) -> str:
    """Return a domain or range; with `single`, it may be an expression."""
    first, second, third = (f"g:C{dice.randrange(CLASSES)}" for _ in range(3))
    part = dice.choice(
        (
            f"[ a owl:Class ; owl:complementOf {second} ]",
            f"[ a owl:Class ; owl:intersectionOf ( {second} [ a owl:Class ; owl:complementOf {third} ] ) ]",
            second,
        )
    )
    union = f"[ a owl:Class ; owl:unionOf ( {first} {part} ) ]"
    return dice.choice((first, union, part)) if single else first


def ours(text: str) -> set[str]:
    """Return the classes that skillc finds impossible."""
    outcome = load([Source("g.ttl", HEAD + text)])
    assert {each.name for each in outcome.diagnostics} <= {
        "impossible-class",
        "impossible-relation",
        "several-inverses",
    }
    graph = Graph(triple for each in read_ontologies([Source("g.ttl", HEAD + text)]).value for triple in each.triples)
    return set(find_unsatisfiable(graph, outcome.value).classes)


@pytest.mark.parametrize("single", [False, True])
def test_a_reasoner_finds_the_same_classes_impossible(single: bool) -> None:
    """With functional relations and unions it may find more, but never less."""
    found: set[str] = set()
    for first in range(0, VOCABULARIES, AT_ONCE):
        texts = ["\n".join(generated(number, single)) for number in range(first, min(first + AT_ONCE, VOCABULARIES))]
        mine = {iri for text in texts for iri in ours(text)}
        theirs = {cls.iri for cls in classified([HEAD + text for text in texts]).inconsistent_classes()} - {NOTHING}
        assert mine - theirs == set()
        assert single or theirs - mine == set()
        found |= mine
    assert len(found) > VOCABULARIES
