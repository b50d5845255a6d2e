"""What Turtle says of terms reaches the vocabulary; broken files are told with their line."""

import pyoxigraph as ox
import pytest

from skillc_dsl.position import Position
from skillc_dsl.source import Source
from skillc_ontology.catalogue import vocabulary_files
from skillc_rdf.turtle.parser import parse
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.positions import find_subjects
from skillc_rdf.vocabulary.types import Bounds, DirectionType, NumberType, PlainType, Signature, VectorType, Vocabulary

HEAD = """@prefix t: <http://example.org/t#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix vann: <http://purl.org/vocab/vann/> .
<http://example.org/t> a owl:Ontology ;
    vann:preferredNamespacePrefix "t" ; vann:preferredNamespaceUri "http://example.org/t#" .
"""
T = "http://example.org/t#"


def loaded(text: str) -> Vocabulary:
    outcome = load([Source("t.ttl", HEAD + text)])
    assert outcome.diagnostics == ()
    return outcome.value


def test_classes() -> None:
    found = loaded(
        't:A a owl:Class ; rdfs:comment "First." .\n'
        "t:B a owl:Class ; rdfs:subClassOf t:A, owl:Thing, [ a owl:Restriction ] .\n"
        "t:C a owl:Class ; owl:disjointWith t:B .\n"
        "t:D a owl:Class . t:E a owl:Class . t:F a owl:Class .\n"
        "[] a owl:AllDisjointClasses ; owl:members ( t:D t:E t:F ) .\n"
        "t:Old a owl:Class ; skillc:aliasOf t:A .\n"
        "t:G a owl:Class ; rdfs:subClassOf t:Old .\n"
    )
    assert found.prefixes == {"t": T}
    assert found.classes[T + "A"].comment == "First."
    assert found.classes[T + "A"].source == Position("t.ttl", 9, 1)
    assert found.classes[T + "B"].parents == (T + "A",)
    assert found.disjoint(T + "B", T + "C") and found.disjoint(T + "C", T + "B")
    assert found.disjoint(T + "D", T + "F") and not found.disjoint(T + "A", T + "F")
    assert found.aliases == {T + "Old": T + "A"} and T + "Old" not in found.classes
    assert found.is_a(T + "G", T + "A")


def test_relations() -> None:
    found = loaded(
        "t:at a owl:ObjectProperty, owl:FunctionalProperty, owl:IrreflexiveProperty ;\n"
        "    rdfs:domain t:A ; rdfs:range t:B ; owl:inverseOf t:has ; rdfs:subPropertyOf t:near .\n"
        "t:has a owl:ObjectProperty .\n"
        "t:near a owl:ObjectProperty, owl:SymmetricProperty, owl:TransitiveProperty .\n"
    )
    at, has, near = (found.relations[T + name] for name in ("at", "has", "near"))
    assert at.signatures == (Signature(T + "A", T + "B"),) and at.functional and at.irreflexive
    assert has.signatures == (Signature(T + "B", T + "A"),) and has.inverse == T + "at" and at.inverse == T + "has"
    assert near.symmetric and near.transitive and not near.functional
    assert found.super_relations[T + "at"] == {T + "at", T + "near"}


def test_properties() -> None:
    found = loaded(
        "t:force a owl:DatatypeProperty ; rdfs:domain [ owl:unionOf ( t:A t:B ) ] ; rdfs:range xsd:double ;\n"
        '    skillc:dimension "Force" .\n'
        "t:share a owl:DatatypeProperty, owl:FunctionalProperty ; rdfs:domain t:A ; rdfs:range xsd:float .\n"
        't:state a owl:DatatypeProperty ; rdfs:range [ a rdfs:Datatype ; owl:oneOf ( "On" "Off" ) ] .\n'
        't:normal a owl:DatatypeProperty ; rdfs:range skillc:Vector ; skillc:computedBy "m:normal" .\n'
        "t:clean a owl:DatatypeProperty ; rdfs:range xsd:boolean ;\n"
        "    skillc:measure t:share ; skillc:threshold t:force .\n"
    )
    force, share, state, normal, clean = (
        found.properties[T + name] for name in ("force", "share", "state", "normal", "clean")
    )
    assert (force.type, force.domains, force.functional) == (NumberType("Force"), (T + "A", T + "B"), False)
    assert (share.type, share.functional) == (NumberType("Number"), True)
    assert (state.type, state.values) == (PlainType("Text"), ("On", "Off"))
    assert (normal.type, normal.computed_by) == (VectorType("Number"), "m:normal")
    assert (clean.type, clean.measure, clean.threshold) == (PlainType("Bool"), T + "share", T + "force")


def test_a_broken_file_is_told_and_the_others_are_read() -> None:
    good = Source("good.ttl", HEAD + "t:A a owl:Class .\n")
    outcome = load([Source("bad.ttl", HEAD + "t:B a owl:Class ;;; ] .\n"), good])
    assert [(d.name, d.span.path, d.span.line) for d in outcome.diagnostics] == [("broken-turtle", "bad.ttl", 9)]
    assert sorted(outcome.value.classes) == [T + "A"]


def test_an_unknown_datatype_is_told() -> None:
    outcome = load([Source("t.ttl", HEAD + "t:when a owl:DatatypeProperty ; rdfs:range xsd:gYears .\n")])
    assert [(d.name, d.severity, d.span.line) for d in outcome.diagnostics] == [("unknown-datatype", "warning", 9)]
    assert outcome.value.properties == {}


def test_vectors_have_a_dimension_and_directions_have_none() -> None:
    found = loaded(
        't:wind a owl:DatatypeProperty ; rdfs:range skillc:Vector ; skillc:dimension "Speed" .\n'
        "t:share a owl:DatatypeProperty ; rdfs:range skillc:Vector .\n"
        "t:up a owl:DatatypeProperty ; rdfs:range skillc:Direction .\n"
    )
    types = {name: found.properties[T + name].type for name in ("wind", "share", "up")}
    assert types == {"wind": VectorType("Speed"), "share": VectorType("Number"), "up": DirectionType()}


@pytest.mark.parametrize(
    ("range_", "dimension", "said"),
    [
        ("xsd:double", "Force", None),
        ("skillc:Vector", "Force", None),
        ("skillc:Vector", "Number", None),
        ("xsd:double", "Froce", "did you mean `Force`?"),
        ("skillc:Vector", "Forces", "did you mean `Force`?"),
        ("skillc:Direction", "Force", "use xsd:double or skillc:Vector as its range, or remove `skillc:dimension`"),
        ("xsd:integer", "Length", "use xsd:double or skillc:Vector as its range, or remove `skillc:dimension`"),
        ("xsd:string", "Length", "use xsd:double or skillc:Vector as its range, or remove `skillc:dimension`"),
    ],
)
def test_a_dimension_is_one_of_the_language_and_stands_at_quantities(
    range_: str, dimension: str, said: str | None
) -> None:
    text = f'{HEAD}t:p a owl:DatatypeProperty ; rdfs:range {range_} ; skillc:dimension "{dimension}" .\n'
    outcome = load([Source("t.ttl", text)])
    found = [(each.name, each.severity, each.span.line, each.help) for each in outcome.diagnostics]
    assert found == ([] if said is None else [("unknown-dimension", "error", 9, said)])


def test_places_are_of_terms_where_they_are_declared() -> None:
    turtle = r"""@prefix ex: <http://e/#> . # ex:Comment a ex:Class .
PREFIX o: <http://o/>
ex:A a o:C ; ex:note "ex:Text a o:C ." , '''ex:Long a
ex:Longer a o:C .''' .  ex:F ex:p 1.5 , 2. ex:G a [ a o:C ; ex:q ( ex:H ex:I ) ] .
  <http://e/#J>
     a o:C .
[] ex:p ex:K . ex:L.m a o:C.
ex:F a o:C.
\tex:M\,n <http://www.w3.org/1999/02/22-rdf-syntax-ns#type> o:C .
""".replace("\\t", "\t")
    places = find_subjects([Source("terms.ttl", turtle)])
    assert {iri.removeprefix("http://e/#"): (at.line, at.column) for iri, at in places.items()} == {
        "A": (3, 1),
        "F": (8, 1),
        "G": (4, 44),
        "J": (5, 3),
        "L.m": (7, 16),
        "M,n": (9, 2),
    }


def test_places_are_those_of_a_whole_parser() -> None:
    shipped = [Source(path, text) for path, text in vocabulary_files()]
    declared: dict[str, tuple[str, int, int]] = {}
    for source in shipped:
        for statement in parse(source.path, source.text).statements:
            if statement.predicate.endswith("#type") and isinstance(statement.subject, ox.NamedNode):
                place = statement.subject_place
                declared.setdefault(statement.subject.value, (place.path, place.line, place.column))
    found = {iri: (at.path, at.line, at.column) for iri, at in find_subjects(shipped).items()}
    assert len(declared) > 150
    assert declared.items() <= found.items()


def test_restrictions_bound_numbers_also_by_the_name_of_a_datatype() -> None:
    found = loaded(
        "t:Share a rdfs:Datatype ; owl:equivalentClass [ a rdfs:Datatype ; owl:onDatatype xsd:double ;\n"
        "    owl:withRestrictions ( [ xsd:minInclusive 0 ] [ xsd:maxExclusive 1 ] ) ] .\n"
        "t:part a owl:DatatypeProperty ; rdfs:range t:Share .\n"
        "t:count a owl:DatatypeProperty ; rdfs:range [ a rdfs:Datatype ; owl:onDatatype xsd:integer ;\n"
        "    owl:withRestrictions ( [ xsd:minExclusive 0 ] [ xsd:maxInclusive 9 ] ) ] .\n"
    )
    part, count = found.properties[T + "part"], found.properties[T + "count"]
    assert part.type == NumberType("Number") and part.bounds == Bounds(least=0.0, below=1.0)
    assert count.type == PlainType("Int") and str(count.bounds) == "above 0 and at most 9"


def test_an_ontology_has_the_prefix_that_it_prefers_also_without_a_namespace() -> None:
    text = HEAD.replace('"t" ; vann:preferredNamespaceUri "http://example.org/t#" .', '"tee" .\nt:A a owl:Class .\n')
    assert load([], [Source("x.ttl", text)]).value.prefixes == {"tee": T}


def test_a_union_of_datatypes_is_what_all_of_them_are() -> None:
    found = loaded(
        "t:Numeric a rdfs:Datatype ; owl:unionOf ( xsd:integer xsd:double ) .\n"
        "t:Named a rdfs:Datatype ; owl:equivalentClass [ a rdfs:Datatype ; owl:unionOf ( xsd:int xsd:long ) ] .\n"
        "t:a a owl:DatatypeProperty ; rdfs:range t:Numeric . t:b a owl:DatatypeProperty ; rdfs:range t:Named .\n"
        "t:c a owl:DatatypeProperty ; rdfs:range [ a rdfs:Datatype ; owl:unionOf ( xsd:string xsd:double ) ] .\n"
        't:d a owl:DatatypeProperty ; rdfs:range t:Numeric ; skillc:dimension "Length" .\n'
    ).properties
    types = [found[T + name].type for name in "abcd"]
    assert types == [NumberType("Number"), PlainType("Int"), PlainType("Text"), NumberType("Length")]
    text = "t:D a rdfs:Datatype ; owl:unionOf ( xsd:int t:D ) . t:p a owl:DatatypeProperty ; rdfs:range t:D .\n"
    assert [each.name for each in load([Source("t.ttl", HEAD + text)]).diagnostics] == ["unknown-datatype"]


def test_a_datatype_that_restricts_itself_is_none() -> None:
    text = "t:D a rdfs:Datatype ; owl:equivalentClass [ a rdfs:Datatype ; owl:onDatatype t:D ] .\n"
    outcome = load([Source("t.ttl", HEAD + text + "t:p a owl:DatatypeProperty ; rdfs:range t:D .\n")])
    assert [each.name for each in outcome.diagnostics] == ["unknown-datatype"]
    assert T + "p" not in outcome.value.properties
