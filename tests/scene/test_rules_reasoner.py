"""What the rules of generated ontologies say of individuals is what a reasoner for OWL 2 DL says."""

from __future__ import annotations

import random
from collections.abc import Iterator
from pathlib import Path

import pytest

from emit.reasoner import needs_java
from skillc_dsl.source import Source
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import read_documents
from vocabularies.reading import HEAD, beside

WORLDS = 25
CLASSES, RELATIONS, INDIVIDUALS = 6, 3, 6

pytestmark = [needs_java, pytest.mark.reasoner]


def ontology(number: int) -> Iterator[str]:
    """Yield the lines of an ontology of which all axioms are rules, or are used otherwise."""
    dice = random.Random(number)
    yield from (f"g{number}:C{each} a owl:Class ." for each in range(CLASSES))
    yield from (f"g{number}:r{each} a owl:ObjectProperty ." for each in range(RELATIONS))
    yield f"g{number}:r1 rdfs:subPropertyOf g{number}:r0 ." * dice.randrange(2)
    yield f"g{number}:r2 owl:inverseOf g{number}:r{dice.randrange(2)} ." * dice.randrange(2)
    for _ in range(dice.randint(2, 4)):
        cls = f"g{number}:C{dice.randrange(CLASSES)}"
        left = expression(dice, number, 2)
        yield dice.choice(
            (
                f"{cls} owl:equivalentClass {left} ." if left[0] == "[" else f"{left} rdfs:subClassOf {cls} .",
                f"{left} rdfs:subClassOf {cls} .",
                f"{cls} rdfs:subClassOf [ a owl:Restriction ; owl:onProperty g{number}:r{dice.randrange(RELATIONS)} ; "
                f"owl:allValuesFrom g{number}:C{dice.randrange(CLASSES)} ] .",
            )
        )


def expression(dice: random.Random, number: int, depth: int) -> str:
    """Return an expression from which membership follows."""
    if depth == 0:
        return f"g{number}:C{dice.randrange(CLASSES)}"
    one, other = (expression(dice, number, depth - 1) for _ in range(2))
    restriction = f"a owl:Restriction ; owl:onProperty g{number}:r{dice.randrange(RELATIONS)}"
    return dice.choice(
        (
            one,
            f"[ a owl:Class ; owl:intersectionOf ( {one} {other} ) ]",
            f"[ a owl:Class ; owl:unionOf ( {one} {other} ) ]",
            f"[ {restriction} ; owl:someValuesFrom {one} ]",
            f"[ {restriction} ; owl:hasValue g{number}:x{dice.randrange(INDIVIDUALS)} ]",
        )
    )


def facts(number: int) -> Iterator[str]:
    dice = random.Random(-number - 1)
    for each in range(INDIVIDUALS):
        yield f"g{number}:x{each} a g{number}:C{dice.randrange(CLASSES)} ."
        yield f"g{number}:x{each} g{number}:r{dice.randrange(RELATIONS)} g{number}:x{dice.randrange(INDIVIDUALS)} ."


def ours(number: int) -> set[tuple[str, str]]:
    """Return the individuals with their classes, as skillc reads them."""
    head = f"{HEAD}@prefix g{number}: <http://example.org/g{number}#> .\n"
    vocabulary = beside(Source("g.ttl", head + "\n".join(ontology(number)))).value
    scene = read_documents([Document.of("cell.ttl", head + "\n".join(facts(number)))], vocabulary)
    assert scene.ok, scene.problems
    classes = scene.state.vocabulary.classes.keys()
    return {
        (one, cls)
        for one in scene.state.individuals
        for named in scene.state.types(one)
        for cls in scene.state.vocabulary.ancestors[named]
        if cls in classes and "/g" in cls
    }


@pytest.fixture(scope="module")
def theirs(tmp_path_factory: pytest.TempPathFactory) -> set[tuple[str, str]]:
    """Return the individuals of all worlds with their classes, as HermiT finds them in one run."""
    owlready2 = pytest.importorskip("owlready2")
    rdflib = pytest.importorskip("rdflib")
    prefixes = "".join(f"@prefix g{each}: <http://example.org/g{each}#> .\n" for each in range(WORLDS))
    lines = [line for each in range(WORLDS) for line in (*ontology(each), *facts(each))]
    lines += [f"g{each}:x{one} a owl:NamedIndividual ." for each in range(WORLDS) for one in range(INDIVIDUALS)]
    graph = rdflib.Graph().parse(data=HEAD + prefixes + "\n".join(lines), format="turtle")
    file = Path(tmp_path_factory.mktemp("hermit"), "all.nt")
    graph.serialize(file, format="nt", encoding="utf-8")
    world = owlready2.World()
    with world.get_ontology(file.as_uri()).load():
        owlready2.sync_reasoner_hermit(world, debug=0)
    return {
        (one.iri, cls.iri)
        for one in world.individuals()
        for named in one.is_a
        for cls in (named.ancestors() if hasattr(named, "ancestors") else ())
        if "/g" in cls.iri
    }


@pytest.mark.parametrize("number", range(WORLDS))
def test_individuals_have_the_classes_that_follow(number: int, theirs: set[tuple[str, str]]) -> None:
    base = f"http://example.org/g{number}#"
    aliases = {each for each in theirs if each[0].startswith(base)}
    assert ours(number) == aliases and aliases
