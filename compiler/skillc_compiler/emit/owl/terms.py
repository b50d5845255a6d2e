"""The vocabulary terms that a library uses, with their axioms, so that its ontology is self-contained."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.emit.owl.turtle import RDF_TYPE, AnonymousNode, IriNode, ListNode, Object
from skillc_compiler.emit.owl.words import DATATYPES, OWL, RDFS, SKILLC, XSD, declare_frame
from skillc_model.conditions import IsA
from skillc_model.format_condition import format_condition
from skillc_model.format_type import SI_UNITS
from skillc_model.read_write import terms_read
from skillc_model.skills import Implementation, Skill, SkillLibrary
from skillc_model.traversal import walk
from skillc_rdf.vocabulary.types import (
    THING,
    ClassType,
    NumberType,
    PlainType,
    PropertyTerm,
    RelationTerm,
    VectorType,
    Vocabulary,
    local_name,
)

Statement = tuple[str, str, Object]
FLAGS = {
    "functional": "FunctionalProperty",
    "inverse_functional": "InverseFunctionalProperty",
    "symmetric": "SymmetricProperty",
    "transitive": "TransitiveProperty",
    "asymmetric": "AsymmetricProperty",
    "irreflexive": "IrreflexiveProperty",
}


def describe_terms(library: SkillLibrary) -> Iterator[Statement]:
    """Yield the frame, the terms that the library declares or mentions, and the terms that these depend on."""
    vocabulary = library.vocabulary
    read = _mentioned(library)
    relations = _relations(read, vocabulary)
    properties = [vocabulary.properties[iri] for iri in sorted(read) if iri in vocabulary.properties]
    classes = _classes(read, relations, properties, vocabulary)
    yield from declare_frame()
    for term in relations:
        yield from _relation(term)
        yield from _definition(term, vocabulary)
    for each in properties:
        yield from _property(each)
    for iri in sorted(classes):
        yield from _class(iri, classes, vocabulary)


def _mentioned(library: SkillLibrary) -> set[str]:
    base = library.namespace
    vocabulary = library.vocabulary
    terms = (*vocabulary.classes, *vocabulary.relations, *vocabulary.properties)
    found = {iri for iri in terms if iri.startswith(base)}
    owners: list[Skill | Implementation] = [*library.skills.values(), *library.implementations.values()]
    for owner in owners:
        found |= {each.type.iri for each in owner.parameters if isinstance(each.type, ClassType)}
        conditions = [each.condition for each in (*owner.pre, *owner.hold)]
        conditions += [each.condition for each in owner.post]
        for condition in conditions:
            found |= terms_read(condition) | {each.cls for each in walk(condition) if isinstance(each, IsA)}
    return found


def _relations(read: set[str], vocabulary: Vocabulary) -> list[RelationTerm]:
    found = {upper for iri in read if iri in vocabulary.relations for upper in vocabulary.super_relations[iri]}
    found |= {inverse for iri in found if (inverse := vocabulary.relations[iri].inverse)}
    return [vocabulary.relations[iri] for iri in sorted(found) if iri in vocabulary.relations]


def _classes(
    read: set[str], relations: list[RelationTerm], properties: list[PropertyTerm], vocabulary: Vocabulary
) -> set[str]:
    found = {iri for iri in read if iri in vocabulary.classes}
    found |= {end for term in relations for each in term.signatures for end in (each.domain, each.range)}
    found |= {domain for term in properties for domain in term.domains}
    return {upper for iri in found for upper in vocabulary.ancestors.get(iri, ())} - {THING}


def _class(iri: str, classes: set[str], vocabulary: Vocabulary) -> Iterator[Statement]:
    term = vocabulary.classes[iri]
    yield iri, RDF_TYPE, IriNode(f"{OWL}Class")
    yield from ((iri, f"{RDFS}subClassOf", IriNode(parent)) for parent in term.parents)
    yield from ((iri, f"{OWL}disjointWith", IriNode(other)) for other in term.disjoint if other in classes)
    if term.comment:
        yield iri, f"{RDFS}comment", term.comment
    if iri in vocabulary.enumerations:
        yield from _enumeration(iri, vocabulary.enumerations[iri])


def _enumeration(iri: str, values: tuple[str, ...]) -> Iterator[Statement]:
    """Yield that a class has these different individuals and no others."""
    members = ListNode(tuple(IriNode(each) for each in values))
    yield (
        iri,
        f"{OWL}equivalentClass",
        AnonymousNode(((RDF_TYPE, IriNode(f"{OWL}Class")), (f"{OWL}oneOf", members))),
    )
    for place, value in enumerate(values):
        yield value, RDF_TYPE, IriNode(f"{OWL}NamedIndividual")
        yield value, RDF_TYPE, IriNode(iri)
        yield from ((value, f"{OWL}differentFrom", IriNode(other)) for other in values[place + 1 :])


def _relation(term: RelationTerm) -> Iterator[Statement]:
    yield term.iri, RDF_TYPE, IriNode(f"{OWL}ObjectProperty")
    for name, kind in FLAGS.items():
        if getattr(term, name):
            yield term.iri, RDF_TYPE, IriNode(f"{OWL}{kind}")
    yield from ((term.iri, f"{RDFS}subPropertyOf", IriNode(parent)) for parent in term.parents)
    if term.inverse:
        yield term.iri, f"{OWL}inverseOf", IriNode(term.inverse)
    for side, ends in (
        ("domain", [each.domain for each in term.signatures]),
        ("range", [each.range for each in term.signatures]),
    ):
        if ends:
            yield term.iri, f"{RDFS}{side}", _union(ends)
    if term.comment:
        yield term.iri, f"{RDFS}comment", term.comment


def _definition(term: RelationTerm, vocabulary: Vocabulary) -> Iterator[Statement]:
    """Yield what a relation is defined as, as an annotation: OWL cannot say that nothing else implies it."""
    definition = vocabulary.definitions.get(term.iri)
    if definition is not None:
        condition = format_condition(definition.condition, vocabulary)
        sides = f"{definition.subject.name} {local_name(term.iri)} {definition.object.name}"
        yield term.iri, f"{SKILLC}definition", f"{sides} = {condition}"


def _property(term: PropertyTerm) -> Iterator[Statement]:
    yield term.iri, RDF_TYPE, IriNode(f"{OWL}DatatypeProperty")
    if term.functional:
        yield term.iri, RDF_TYPE, IriNode(f"{OWL}FunctionalProperty")
    if term.domains:
        yield term.iri, f"{RDFS}domain", _union(list(term.domains))
    datatype = _datatype(term)
    if datatype is not None:
        yield term.iri, f"{RDFS}range", datatype
    if isinstance(term.type, NumberType | VectorType) and term.type.dimension in SI_UNITS:
        yield term.iri, f"{SKILLC}dimension", term.type.dimension
    if term.comment:
        yield term.iri, f"{RDFS}comment", term.comment


def _datatype(term: PropertyTerm) -> Object | None:
    """Return the range as a datatype; None for poses, vectors and lists, which are not datatypes in OWL."""
    if term.values:
        values = ListNode(tuple(term.values))
        return AnonymousNode(((RDF_TYPE, IriNode(f"{RDFS}Datatype")), (f"{OWL}oneOf", values)))
    match term.type:
        case NumberType():
            return IriNode(f"{XSD}double")
        case PlainType(name=name) if name in DATATYPES:
            return IriNode(DATATYPES[name])
    return None


def _union(classes: list[str]) -> Object:
    """Return the class, or the union of several: overloads accept each, and separate axioms would intersect them."""
    unique = sorted(set(classes))
    if len(unique) == 1:
        return IriNode(unique[0])
    members = ListNode(tuple(IriNode(each) for each in unique))
    return AnonymousNode(((RDF_TYPE, IriNode(f"{OWL}Class")), (f"{OWL}unionOf", members)))
