"""The terms of RDF, RDFS and OWL, for finding misspelt ones."""

from __future__ import annotations

from functools import lru_cache

from skillc_rdf.turtle.terms import OWL, RDF, RDFS

_NAMES = {
    RDF: "type first rest nil value subject predicate object Statement Property List Bag Seq Alt langString",
    RDFS: (
        "label comment seeAlso isDefinedBy subClassOf subPropertyOf domain range member "
        "Class Datatype Literal Resource Container ContainerMembershipProperty"
    ),
    OWL: (
        "Class class Thing Nothing NamedIndividual Ontology Restriction Axiom Annotation AllDisjointClasses "
        "AllDifferent AllDisjointProperties ObjectProperty DatatypeProperty AnnotationProperty OntologyProperty "
        "FunctionalProperty InverseFunctionalProperty SymmetricProperty AsymmetricProperty ReflexiveProperty "
        "IrreflexiveProperty TransitiveProperty DataRange DeprecatedClass DeprecatedProperty "
        "NegativePropertyAssertion imports versionInfo versionIRI priorVersion backwardCompatibleWith "
        "incompatibleWith deprecated equivalentClass equivalentProperty disjointWith disjointUnionOf "
        "propertyDisjointWith inverseOf sameAs differentFrom members distinctMembers onProperty onProperties "
        "onClass onDataRange onDatatype withRestrictions someValuesFrom allValuesFrom hasValue hasSelf hasKey "
        "cardinality minCardinality maxCardinality qualifiedCardinality minQualifiedCardinality "
        "maxQualifiedCardinality unionOf intersectionOf complementOf datatypeComplementOf oneOf propertyChainAxiom "
        "annotatedSource annotatedProperty annotatedTarget sourceIndividual assertionProperty targetIndividual "
        "targetValue topObjectProperty bottomObjectProperty topDataProperty bottomDataProperty"
    ),
}
TERMS = frozenset(base + name for base, names in _NAMES.items() for name in names.split())
"""`owl:class` is included because scenes of SkiROS2 write it instead of `owl:Class`."""


def standard_terms(iri: str) -> frozenset[str]:
    """Return the terms of the vocabulary that an IRI belongs to."""
    base = next(base for base in _NAMES if iri.startswith(base))
    return frozenset(term for term in TERMS if term.startswith(base))


@lru_cache(maxsize=1024)
def is_misspelt(iri: str) -> bool:
    """Whether an IRI is in the namespace of one of these vocabularies but is not one of its terms."""
    return iri.startswith(tuple(_NAMES)) and iri not in TERMS and not iri.startswith(f"{RDF}_")
