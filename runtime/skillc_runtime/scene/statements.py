"""Selects the statements that are facts about individuals; classes and labels that documents declare."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Sequence

import msgspec
import pyoxigraph as ox

from skillc_rdf.turtle.statements import Node, Parsed, Statement
from skillc_rdf.turtle.terms import OWL, RDF, RDF_TYPE, RDFS
from skillc_rdf.vocabulary.types import THING, ClassTerm, Vocabulary
from skillc_runtime.scene.documents import Document, statements_of
from skillc_runtime.world.state.terms import HAS_TEMPLATE, TEMPLATE

ABOUT_TERMS = (OWL, RDFS, RDF, "http://purl.org/vocab/vann/")
ANNOTATIONS = (
    "http://purl.org/dc/terms/",
    "http://purl.org/dc/elements/1.1/",
    "http://www.w3.org/2004/02/skos/core#",
    "http://www.w3.org/ns/prov#",
    "http://www.w3.org/ns/shacl#",
)
"""Statements with these vocabularies are for people and other tools."""
NOT_OF_WORLDS = (*ABOUT_TERMS, *ANNOTATIONS)
REMARKS = frozenset(
    {f"{RDFS}{name}" for name in ("label", "comment", "seeAlso", "isDefinedBy")}
    | {f"{OWL}{name}" for name in ("versionInfo", "versionIRI", "priorVersion", "deprecated")}
    | {f"{OWL}{name}" for name in ("backwardCompatibleWith", "incompatibleWith")}
)
CLASS_DECLARATIONS = (f"{OWL}Class", f"{OWL}class")  # SkiROS2's scenes write the second
SUBCLASS = f"{RDFS}subClassOf"
NAMED_INDIVIDUAL, ANNOTATION = f"{OWL}NamedIndividual", f"{OWL}AnnotationProperty"


class FactFilter:
    """Decides which statements are facts about individuals: not about terms or templates, and not annotations.

    `terms` are subjects that are not individuals, including the empty IRI of blank nodes.
    """

    def __init__(self, vocabulary: Vocabulary, types: Collection[tuple[str, str]]) -> None:
        """Use the types that a text states, as pairs of subject and class."""
        kinds = {cls for cls in {cls for _, cls in types} if is_term_kind(cls)}
        self.terms = terms_of(vocabulary) | {subject for subject, cls in types if cls in kinds} | {""}
        notes = {subject for subject, cls in types if cls == ANNOTATION} - vocabulary.properties.keys()
        self._passed = notes | {TEMPLATE, HAS_TEMPLATE}

    def may_state_facts(self, predicate: str) -> bool:
        """Whether a statement about an individual with this predicate is a fact."""
        return predicate not in self._passed and not is_remark(predicate)


def select_facts(said: Sequence[Statement], vocabulary: Vocabulary) -> tuple[Statement, ...]:
    """Return the statements that are facts about individuals: not about terms or templates, and not annotations."""
    kept = FactFilter(vocabulary, pairs(said, RDF_TYPE))
    return tuple(
        each
        for each in said
        if iri_of(each.subject) not in kept.terms
        and kept.may_state_facts(each.predicate)
        and iri_of(each.object) != NAMED_INDIVIDUAL
    )


def with_prefixes(vocabulary: Vocabulary, parsed: Sequence[Parsed]) -> Vocabulary:
    """Return the vocabulary with the additional prefixes of documents; those of the first document have priority."""
    prefixes = {name: base for document in reversed(parsed) for name, base in document.prefixes.items() if name}
    return msgspec.structs.replace(vocabulary, prefixes={**prefixes, **vocabulary.prefixes})


def with_classes(
    vocabulary: Vocabulary, types: Iterable[tuple[str, str]], subclasses: Iterable[tuple[str, str]]
) -> Vocabulary:
    """Return the vocabulary with the additional classes that a text declares.

    `types` are pairs of subject and class, `subclasses` are pairs of class and superclass.
    """
    missing = {subject for subject, cls in types if cls in CLASS_DECLARATIONS} - terms_of(vocabulary) - {""}
    if not missing:
        return vocabulary
    parents: dict[str, list[str]] = defaultdict(list)
    for cls, parent in subclasses:
        if parent:
            parents[cls].append(parent)
    own = {iri: ClassTerm(iri=iri, parents=tuple(parents[iri])) for iri in sorted(missing)}
    return msgspec.structs.replace(vocabulary, classes={**vocabulary.classes, **own})


def with_own_classes(vocabulary: Vocabulary, said: Sequence[Statement]) -> Vocabulary:
    """Return the vocabulary with the additional classes that statements declare."""
    return with_classes(vocabulary, pairs(said, RDF_TYPE), pairs(said, SUBCLASS))


def terms_of(vocabulary: Vocabulary) -> set[str]:
    """Return all terms of a vocabulary; statements about them are not facts."""
    return {*vocabulary.classes, *vocabulary.relations, *vocabulary.properties, *vocabulary.aliases}


def is_term_kind(cls: str) -> bool:
    """Whether instances of a class are terms or templates instead of individuals."""
    return cls == TEMPLATE or (cls.startswith((OWL, RDFS, RDF)) and cls not in (THING, NAMED_INDIVIDUAL))


def is_remark(predicate: str) -> bool:
    """Whether statements with a predicate are for people and other tools."""
    return predicate != RDF_TYPE and predicate.startswith(NOT_OF_WORLDS)


def is_annotation(predicate: str) -> bool:
    """Whether a predicate is an annotation, which has no meaning for the world."""
    return predicate in REMARKS or predicate.startswith((*ANNOTATIONS, ABOUT_TERMS[-1]))


def iri_of(node: Node) -> str:
    """Return the IRI of a node; empty for a blank node or a literal."""
    return node.value if isinstance(node, ox.NamedNode) else ""


def pairs(said: Iterable[Statement], predicate: str) -> list[tuple[str, str]]:
    """Return subjects and objects of the statements with a predicate; empty for nodes without IRI."""
    return [(iri_of(each.subject), iri_of(each.object)) for each in said if each.predicate == predicate]


LABEL = f"{RDFS}label"


class SubjectsAndLabels(msgspec.Struct, frozen=True):
    """The subjects of the statements in files, and the first rdfs:label of those that have one, by IRI."""

    subjects: frozenset[str]
    labels: dict[str, str]


def read_contents(documents: Iterable[Document]) -> SubjectsAndLabels:
    """Return the subjects and labels in documents; SceneError for a document that is not Turtle."""
    said = [each for document in documents for each in statements_of(document)]
    labels: dict[str, str] = {}
    for each in said:
        if each.predicate == LABEL and isinstance(each.object, ox.Literal):
            labels.setdefault(iri_of(each.subject), each.object.value)
    return SubjectsAndLabels(frozenset(iri_of(each.subject) for each in said) - {""}, labels)
