"""What follows from a relation by the axioms of the vocabulary, with one name for a relation and its inverse."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from skillc_rdf.vocabulary.closure import Directed
from skillc_rdf.vocabulary.types import Vocabulary


@dataclass(frozen=True)
class Axioms:
    """Relations by their one name: `name[r]` is that of `r`, and whether `r` reads it backwards.

    `implied[r]` are the relations that hold where `r` does, `sources[r]` those whose presence implies it. `loose` ones
    may hold by a chain of facts, so that no single fact decides them. `single_object` ones are functional,
    `single_subject` ones inverse functional. `kin[r]` are the IRIs of all relations that a change of `r` may touch.
    """

    name: Mapping[str, Directed]
    implied: Mapping[str, tuple[Directed, ...]]
    sources: Mapping[str, tuple[Directed, ...]]
    loose: frozenset[str]
    single_object: frozenset[str]
    single_subject: frozenset[str]
    asymmetric: frozenset[str]
    irreflexive: frozenset[str]
    kin: Mapping[str, frozenset[str]]


def axioms_of(vocabulary: Vocabulary) -> Axioms:
    """Return the axioms of all relations of a vocabulary."""
    relations, closure = vocabulary.relations, vocabulary.closure
    name = {iri: closure.canonical(iri) for iri in relations}
    bases = dict.fromkeys(base for base, _ in name.values())
    flags = {
        flag: {name[iri] for iri, term in relations.items() if getattr(term, flag)}
        for flag in ("functional", "inverse_functional", "asymmetric", "irreflexive")
    }
    straight, turned = flags["functional"], flags["inverse_functional"]
    single_object = {iri for iri in bases if Directed(iri) in straight or Directed(iri, True) in turned}
    single_subject = {iri for iri in bases if Directed(iri) in turned or Directed(iri, True) in straight}
    implied = {iri: closure.canonical_implied[iri] for iri in bases}
    sources = {iri: closure.canonical_sources[iri] for iri in bases}
    return Axioms(
        name,
        implied,
        sources,
        frozenset(bases.keys() & closure.chained),
        frozenset(single_object),
        frozenset(single_subject),
        frozenset(iri for iri, _ in flags["asymmetric"]),
        frozenset(iri for iri, _ in flags["irreflexive"]),
        {iri: _kin(iri, name, implied, sources) for iri in bases},
    )


def _kin(
    iri: str,
    name: Mapping[str, Directed],
    implied: Mapping[str, tuple[Directed, ...]],
    sources: Mapping[str, tuple[Directed, ...]],
) -> frozenset[str]:
    below = {source for above, _ in implied[iri] for source, _ in sources[above]}
    bases = {above for source in below for above, _ in implied[source]}
    return frozenset(each for each, (base, _) in name.items() if base in bases)
