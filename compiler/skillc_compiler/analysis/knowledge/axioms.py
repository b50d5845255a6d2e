"""What follows from relations by the axioms of the vocabulary, with one name for a relation and its inverse."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from skillc_rdf.vocabulary.closure import Directed, OnDemand
from skillc_rdf.vocabulary.types import Vocabulary


class CanonicalAxioms(msgspec.Struct, frozen=True):
    """The axioms of all relations, by canonical IRI.

    `canonical[r]` is the canonical name of `r`, and whether `r` reads it backwards. `implied[r]` are the relations that
    hold where `r` holds; `sources[r]` are those that imply `r`. Relations in `chained` may hold by a chain of facts, so
    that no single fact decides them; those in `transitive` are transitive themselves, not only above such a one.
    Relations in `single_object` are functional, those in `single_subject` inverse functional; no chain of one in
    `acyclic` leads back to where it begins. `affected[r]` are the IRIs of all relations that may change with `r`.
    """

    canonical: Mapping[str, Directed]
    implied: Mapping[str, tuple[Directed, ...]]
    sources: Mapping[str, tuple[Directed, ...]]
    chained: frozenset[str]
    transitive: frozenset[str]
    single_object: frozenset[str]
    single_subject: frozenset[str]
    asymmetric: frozenset[str]
    irreflexive: frozenset[str]
    acyclic: frozenset[str]
    affected: Mapping[str, frozenset[str]]


def build_axioms(vocabulary: Vocabulary) -> CanonicalAxioms:
    """Return the axioms of all relations of a vocabulary."""
    relations, closure = vocabulary.relations, vocabulary.closure
    name = {iri: closure.canonical(iri) for iri in relations}
    bases = dict.fromkeys(base for base, _ in name.values())
    flags = {
        flag: {name[iri] for iri, term in relations.items() if getattr(term, flag)}
        for flag in ("functional", "inverse_functional", "asymmetric", "irreflexive", "is_acyclic")
    }
    straight, turned = flags["functional"], flags["inverse_functional"]
    single_object = {iri for iri in bases if Directed(iri) in straight or Directed(iri, True) in turned}
    single_subject = {iri for iri in bases if Directed(iri) in turned or Directed(iri, True) in straight}
    return CanonicalAxioms(
        name,
        OnDemand(bases, closure.canonical_implied.__getitem__),
        OnDemand(bases, closure.canonical_sources.__getitem__),
        frozenset(bases.keys() & closure.chained),
        frozenset(bases.keys() & closure.transitive),
        frozenset(single_object),
        frozenset(single_subject),
        frozenset(iri for iri, _ in flags["asymmetric"] | flags["is_acyclic"]),
        frozenset(iri for iri, _ in flags["irreflexive"] | flags["is_acyclic"]),
        frozenset(iri for iri, _ in flags["is_acyclic"]),
        OnDemand(bases, lambda iri: closure.above(closure.below(closure.above([iri])))),
    )
