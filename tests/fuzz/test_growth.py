"""Texts that once took time in the square of their length, or twice as long with each part, are read in linear time."""

from __future__ import annotations

import re

import pytest

from fuzz.kinds._doors import DOORS, HEAD
from fuzz.kinds._growth import MOST_EXPONENT, measure_growth
from fuzz.kinds.growth import Shape, check_growth
from skillc_compiler.analysis.knowledge.axioms import build_axioms
from skillc_dsl.encoding import MOST_CHARACTERS
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.load import load

SKILL = "use skiros\nskill S {\n in a: Location\n"
ONCE = [
    ("detect", Shape('<?xml version="1.0"?>\n', "<!-- c -->\n", "", "", "<rdf:RDF/>")),
    ("address", Shape("http://", "a0 http://", "", "", "")),
    ("page", Shape("a", " ", "", "", "")),
    ("question", Shape("", "1.1", "", "", "")),
    pytest.param("turtle", Shape("", "..a", "", "", ""), marks=pytest.mark.slow),
    pytest.param(
        "turtle", Shape("", "@prefix pp0: <http://p0#> .\n", "", "qp0:a a qp0:b .\n", ""), marks=pytest.mark.slow
    ),
    pytest.param("query", Shape("", '\\"', "", "", ""), marks=pytest.mark.slow),
    pytest.param("suppressions", Shape("", "# allow x0: why\n", "", "", ""), marks=pytest.mark.slow),
    pytest.param("reparse", Shape("", "# c\n", "", "", ""), marks=pytest.mark.slow),
    pytest.param("editor", Shape("use skiros\n", "skill S0 {\n", "", "", ""), marks=pytest.mark.slow),
    pytest.param("parse", Shape("", "skill S0 {\n", "", "", ""), marks=pytest.mark.slow),
    pytest.param(
        "compile", Shape(SKILL, " in a0: Product\n", "", " pre a contain a0\n", "}\n"), marks=pytest.mark.slow
    ),
    pytest.param(
        "compile", Shape(SKILL, " in a0: Product\n", "", " post a contain a0\n", "}\n"), marks=pytest.mark.slow
    ),
    pytest.param(
        "compile", Shape(f"{SKILL} in p: Product\n", " post a contain p\n", "", "", "}\n"), marks=pytest.mark.slow
    ),
    pytest.param("compile", Shape(SKILL, " in a0: Location\n pre a0 == a\n", "", "", "}\n"), marks=pytest.mark.slow),
    pytest.param(
        "compile", Shape(f"{SKILL}}}\n", "impl i0 of S {\n do wait 1 s\n}\n", "", "", ""), marks=pytest.mark.slow
    ),
    pytest.param(
        "compile",
        Shape(f"{SKILL}}}\nimpl i of S {{\n do sel {{\n", "wait 1 s\n", "", "", " }\n}\n"),
        marks=pytest.mark.slow,
    ),
    pytest.param("compile", Shape(SKILL, " pre a.Weight < 10 kg\n", "", "", "}\n"), marks=pytest.mark.slow),
    pytest.param(
        "compile",
        Shape("use skiros\n", "skill S0 {\n in a: Product\n}\n", "", "impl i0 of Foo0 {\n do wait 1 s\n}\n", ""),
        marks=pytest.mark.slow,
    ),
    pytest.param(
        "vocabulary",
        Shape(HEAD + "ex:r a owl:ObjectProperty .\n", "ex:A0 a owl:Class .\nex:r rdfs:domain ex:A0 .\n", "", "", ""),
        marks=pytest.mark.slow,
    ),
    pytest.param(
        "vocabulary",
        Shape(
            '{"@context": {"ex": "http://e/", "rdfs": "http://www.w3.org/2000/01/rdf-schema#"}, "@graph": [{}',
            ',\n{"@id": "ex:A0", "@type": "http://www.w3.org/2002/07/owl#Class", "rdfs:subClassOf": {"@id": "ex:B0"}}',
            "",
            "",
            "]}",
        ),
        marks=pytest.mark.slow,
    ),
    pytest.param(
        "scene",
        Shape(HEAD + "lab:g {\n", f"lab:a0 skiros:contain lab:b0 . # {'c' * 300}\n", "", "", "}\n"),
        marks=pytest.mark.slow,
    ),
    pytest.param("goal", Shape("", "a", "", "", " "), marks=pytest.mark.slow),
]


@pytest.mark.parametrize(("door", "shape"), ONCE)
def test_what_once_took_long_grows_with_its_length(door: str, shape: Shape) -> None:
    check_growth(door, shape)


HIERARCHIES = [
    "ex:r{one} a owl:ObjectProperty ; owl:inverseOf ex:r{next} .\n",
    "ex:r{one} a owl:ObjectProperty ; owl:inverseOf ex:inverse .\n",
    "ex:r{one} a owl:ObjectProperty ; rdfs:subPropertyOf ex:r{next} .\n",
    "ex:r{one} a owl:SymmetricProperty ; rdfs:subPropertyOf ex:r{next} .\n",
    "ex:r{one} a owl:AsymmetricProperty ; owl:inverseOf ex:s{one} ; rdfs:subPropertyOf ex:r{next} .\n",
    "ex:C{one} owl:disjointWith ex:D{one} .\n"
    "ex:r{one} a owl:ObjectProperty ; rdfs:domain ex:C{one} ; rdfs:subPropertyOf ex:r{next} .\n",
]


@pytest.mark.slow
@pytest.mark.parametrize("axiom", HIERARCHIES)
def test_chains_of_relations_are_read_in_linear_time(axiom: str) -> None:
    def make(count: int) -> str:
        return HEAD + "".join(axiom.format(one=number, next=number + 1) for number in range(count))

    growth = measure_growth(lambda text: build_axioms(load([], [Source("a.ttl", text)]).value), make, MOST_CHARACTERS)
    assert growth.exponent <= MOST_EXPONENT, growth


MODELS = [
    '<model name="m{}"><link name="l"><collision name="c"><geometry><sphere><radius>1</radius></sphere></geometry>'
    "</collision></link></model>",
    '<model name="same"><link name="l"><collision name="c"><geometry><sphere><radius>1</radius></sphere></geometry>'
    "</collision></link></model>",
]


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS)
def test_worlds_of_many_models_are_read_in_linear_time(model: str) -> None:
    def make(count: int) -> str:
        return "<sdf version='1.6'><world name='w'>" + "".join(map(model.format, range(count))) + "</world></sdf>"

    growth = measure_growth(DOORS["scenery"].read, make, MOST_CHARACTERS)
    assert growth.exponent <= MOST_EXPONENT, growth


@pytest.mark.slow
def test_the_square_of_the_length_is_noticed() -> None:
    pattern = re.compile("a*b")
    measured = (measure_growth(pattern.search, lambda count: "a" * count, 100_000).exponent for _ in range(5))
    assert any(exponent > MOST_EXPONENT for exponent in measured)
