"""Which statements of Turtle documents are facts about individuals, and the classes a scene declares itself."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence, Set

import msgspec
import pyoxigraph as ox

from skillc_compiler.library.vocabulary import THING, ClassTerm, Vocabulary
from skillc_compiler.turtle.statements import Node, Parsed, Statement
from skillc_compiler.turtle.terms import OWL, RDF, RDF_TYPE, RDFS
from skillc_runtime.world.state.terms import HAS_TEMPLATE, TEMPLATE

ABOUT_TERMS = (OWL, RDFS, RDF, "http://purl.org/vocab/vann/")
ANNOTATIONS = (
    "http://purl.org/dc/terms/",
    "http://purl.org/dc/elements/1.1/",
    "http://www.w3.org/2004/02/skos/core#",
    "http://www.w3.org/ns/prov#",
    "http://www.w3.org/ns/shacl#",
)
"""What is said in these vocabularies is for people and other tools."""
REMARKS = frozenset(
    {f"{RDFS}{name}" for name in ("label", "comment", "seeAlso", "isDefinedBy")}
    | {f"{OWL}{name}" for name in ("versionInfo", "versionIRI", "priorVersion", "deprecated")}
    | {f"{OWL}{name}" for name in ("backwardCompatibleWith", "incompatibleWith")}
)
CLASS_DECLARATIONS = (f"{OWL}Class", f"{OWL}class")  # SkiROS2's scenes write the second
SUBCLASS = f"{RDFS}subClassOf"
NAMED_INDIVIDUAL, ANNOTATION = f"{OWL}NamedIndividual", f"{OWL}AnnotationProperty"


def with_own_prefixes(vocabulary: Vocabulary, parsed: Sequence[Parsed]) -> Vocabulary:
    """Return the vocabulary with the prefixes that the documents declare beside it; the first document's win."""
    prefixes = {name: base for document in reversed(parsed) for name, base in document.prefixes.items() if name}
    return msgspec.structs.replace(vocabulary, prefixes={**prefixes, **vocabulary.prefixes})


def with_own_classes(vocabulary: Vocabulary, said: Sequence[Statement]) -> Vocabulary:
    """Return the vocabulary with the classes that the documents declare beside it; a relation is no class."""
    declared = {s for kind in CLASS_DECLARATIONS for s in _typed(said, kind)}
    parents = ((iri_of(each.subject), iri_of(each.object)) for each in said if each.predicate == SUBCLASS)
    return with_classes(vocabulary, declared, parents)


def with_classes(vocabulary: Vocabulary, declared: Set[str], subclass: Iterable[tuple[str, str]]) -> Vocabulary:
    """Return the vocabulary with classes that it lacks; pairs say which class is below which."""
    missing = sorted(declared - terms_of(vocabulary))
    if not missing:
        return vocabulary
    parents: dict[str, list[str]] = defaultdict(list)
    for cls, parent in subclass:
        if parent:
            parents[cls].append(parent)
    own = {iri: ClassTerm(iri=iri, parents=tuple(parents[iri])) for iri in missing}
    return msgspec.structs.replace(vocabulary, classes={**vocabulary.classes, **own})


def facts(said: Sequence[Statement], vocabulary: Vocabulary) -> tuple[Statement, ...]:
    """Return what is said of individuals: not of terms, not of templates, no annotations."""
    terms = terms_of(vocabulary)
    for each in said:
        if each.predicate == RDF_TYPE and is_term_kind(iri_of(each.object)):
            terms.add(iri_of(each.subject))
    notes = set(_typed(said, ANNOTATION)) - vocabulary.properties.keys() | {TEMPLATE, HAS_TEMPLATE}
    return tuple(
        each
        for each in said
        if isinstance(each.subject, ox.NamedNode)
        and each.subject.value not in terms
        and each.predicate not in notes
        and not is_remark(each.predicate)
        and iri_of(each.object) != NAMED_INDIVIDUAL
    )


def terms_of(vocabulary: Vocabulary) -> set[str]:
    """Return all that a vocabulary has names for; statements about these are no facts."""
    return {*vocabulary.classes, *vocabulary.relations, *vocabulary.properties, *vocabulary.aliases}


def is_term_kind(cls: str) -> bool:
    """Whether what is of this class is a term, or a template, and no individual."""
    return cls == TEMPLATE or (cls.startswith((OWL, RDFS, RDF)) and cls not in (THING, NAMED_INDIVIDUAL))


def is_remark(predicate: str) -> bool:
    """Whether what is said with a predicate is for people and other tools."""
    return predicate != RDF_TYPE and predicate.startswith((*ABOUT_TERMS, *ANNOTATIONS))


def is_annotation(predicate: str) -> bool:
    """Whether a predicate says something for people and other tools, and nothing that a world could know."""
    return predicate in REMARKS or predicate.startswith((*ANNOTATIONS, ABOUT_TERMS[-1]))


def iri_of(node: Node) -> str:
    """Return the IRI of a node, nothing for a blank node or a literal."""
    return node.value if isinstance(node, ox.NamedNode) else ""


def _typed(said: Sequence[Statement], kind: str) -> list[str]:
    return [iri_of(each.subject) for each in said if each.predicate == RDF_TYPE and iri_of(each.object) == kind]
