"""The packaged Turtle files use only terms that one of them declares, and say of each what it means."""

import re
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

import pytest
from packaged import FILES, SCENES, name, vocabulary, with_scene
from rdflib import OWL, RDF, RDFS, Graph, URIRef
from rdflib.namespace import VANN

from skillc_runtime.world.state import terms

KINDS = (OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty, RDFS.Datatype)
PREFIXES = "".join(
    f"@prefix {prefix}: <{base}> .\n"
    for prefix, base in (
        ("owl", OWL),
        ("rdfs", RDFS),
        ("skillc", terms.SKILLC),
        ("skiros", terms.SKIROS),
        ("wiping", terms.WIPING),
        ("lab", "http://example.org/lab#"),
    )
)
RUNTIME = Path(terms.__file__).parents[2]


@cache
def bases() -> tuple[str, ...]:
    """The packaged namespaces."""
    return tuple(str(base) for base in vocabulary().objects(None, VANN.preferredNamespaceUri))


def undeclared(graph: Graph, declared: Graph) -> set[str]:
    """What the first graph says something of or with, in a packaged namespace, and the second says nothing about."""
    used = {str(node) for statement in graph for node in statement if isinstance(node, URIRef)}
    known = {str(subject) for subject in declared.subjects(RDF.type)}
    return {iri for iri in used - known if iri.startswith(bases())}


def uncommented(graph: Graph) -> set[str]:
    """The terms without rdfs:comment."""
    found = {term for kind in KINDS for term in graph.subjects(RDF.type, kind) if isinstance(term, URIRef)}
    return {str(term) for term in found if not str(graph.value(term, RDFS.comment) or "").strip()}


def unused_prefixes(text: str) -> Iterator[str]:
    """The prefixes that a Turtle text declares and does not use."""
    body = re.sub(r'"[^"\n]*"|^@prefix.*$|^#.*$', "", text, flags=re.MULTILINE)
    for prefix in re.findall(r"^@prefix\s+([\w-]*):", text, re.MULTILINE):
        if not re.search(rf"(?<![\w-]){prefix}:\w", body):
            yield prefix


def read(text: str) -> Graph:
    return Graph().parse(data=PREFIXES + text, format="turtle")


@pytest.mark.slow
@pytest.mark.parametrize("path", FILES, ids=name)
def test_every_term_used_is_declared(path: Path) -> None:
    declared = with_scene(path.name) if path.name in SCENES else vocabulary()
    assert undeclared(Graph().parse(path), declared) == set()


@pytest.mark.parametrize(
    "text", ["lab:A a skillc:Surfase .", "lab:A wiping:friction 1.0 .", "lab:A skiros:at skiros:X ."]
)
def test_a_term_that_nobody_declares_is_found(text: str) -> None:
    assert len(undeclared(read(text), vocabulary())) == 1


def test_every_term_has_a_comment() -> None:
    assert len(bases()) == 11
    assert uncommented(vocabulary()) == set()


def test_a_term_without_comment_is_found() -> None:
    assert uncommented(read('skillc:A a owl:Class . skillc:B a owl:Class ; rdfs:comment "" .')) == {
        terms.SKILLC + "A",
        terms.SKILLC + "B",
    }


@pytest.mark.parametrize("path", FILES, ids=name)
def test_every_prefix_is_used(path: Path) -> None:
    assert list(unused_prefixes(path.read_text("utf-8"))) == []


def test_an_unused_prefix_is_found() -> None:
    text = "@prefix a: <http://a#> .\n@prefix ab: <http://ab#> .\n# a:comment\nab:x ab:y 'n' ; ab:z \"a:text\" .\n"
    assert list(unused_prefixes(text)) == ["a"]


def named_in_code() -> Iterable[str]:
    for constant, value in vars(terms).items():
        if constant.isupper() and not str(value).endswith("#"):  # not a namespace
            yield from (value,) if isinstance(value, str) else value


def test_the_terms_of_the_code_are_declared() -> None:
    found = set(named_in_code()) - {terms.TEMPLATE, terms.HAS_TEMPLATE}
    assert len(found) > 30
    assert found - {str(term) for term in vocabulary().subjects(RDF.type)} == set()


def test_no_other_module_spells_an_iri_of_the_vocabularies() -> None:
    modules = [path for path in RUNTIME.glob("**/*.py") if path != Path(terms.__file__)]
    assert len(modules) > 100
    spelt = {path.name for path in modules if any(base in path.read_text("utf-8") for base in bases())}
    assert not spelt
