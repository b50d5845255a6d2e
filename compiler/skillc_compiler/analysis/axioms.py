"""What follows from a relation by the axioms of the vocabulary, with one name for a relation and its inverse."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from skillc_compiler.library.vocabulary import RelationTerm, Vocabulary

Directed: TypeAlias = tuple[str, bool]
"""A relation, and whether it is read from object to subject."""


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
    relations = vocabulary.relations
    name = {iri: _name(relations, iri) for iri in relations}
    steps = _steps(relations, name)
    implied = {iri: _reach(iri, steps) for iri in steps}
    sources = {
        iri: tuple((source, turned) for source, reached in implied.items() for x, turned in reached if x == iri)
        for iri in steps
    }
    chained = {name[iri][0] for iri, term in relations.items() if term.transitive}
    loose = {x for iri in chained for x, _ in implied[iri]}
    flags = {
        flag: {name[iri] for iri, term in relations.items() if getattr(term, flag)}
        for flag in ("functional", "inverse_functional", "asymmetric", "irreflexive")
    }
    straight, turned = flags["functional"], flags["inverse_functional"]
    single_object = {iri for iri in steps if (iri, False) in straight or (iri, True) in turned}
    single_subject = {iri for iri in steps if (iri, False) in turned or (iri, True) in straight}
    return Axioms(
        name,
        implied,
        sources,
        frozenset(loose),
        frozenset(single_object),
        frozenset(single_subject),
        frozenset(iri for iri, _ in flags["asymmetric"]),
        frozenset(iri for iri, _ in flags["irreflexive"]),
        {iri: _kin(iri, name, implied, sources) for iri in steps},
    )


def _name(relations: Mapping[str, RelationTerm], iri: str) -> Directed:
    other = relations[iri].inverse
    if other is None:
        other = next((each for each, term in relations.items() if term.inverse == iri), None)
    return (other, True) if other is not None and other in relations and other < iri else (iri, False)


def _steps(relations: Mapping[str, RelationTerm], name: Mapping[str, Directed]) -> dict[str, set[Directed]]:
    steps: dict[str, set[Directed]] = {base: set() for base, _ in name.values()}
    for iri, term in relations.items():
        base, turned = name[iri]
        for parent in (parent for parent in term.parents if parent in relations):
            above, above_turned = name[parent]
            steps[base].add((above, turned != above_turned))
        if term.symmetric or (term.inverse == iri):
            steps[base].add((base, True))
    return steps


def _reach(start: str, steps: Mapping[str, Iterable[Directed]]) -> tuple[Directed, ...]:
    seen: set[Directed] = set()
    todo: list[Directed] = [(start, False)]
    while todo:
        relation, turned = todo.pop()
        if (relation, turned) not in seen:
            seen.add((relation, turned))
            todo.extend((other, turned != turn) for other, turn in steps[relation])
    return tuple(sorted(seen))


def _kin(
    iri: str,
    name: Mapping[str, Directed],
    implied: Mapping[str, Iterable[Directed]],
    sources: Mapping[str, Iterable[Directed]],
) -> frozenset[str]:
    below = {source for above, _ in implied[iri] for source, _ in sources[above]}
    bases = {above for source in below for above, _ in implied[source]}
    return frozenset(each for each, (base, _) in name.items() if base in bases)
