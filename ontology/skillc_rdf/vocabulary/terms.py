"""Makes the terms of a vocabulary from a graph."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import combinations

import msgspec
import pyoxigraph as ox

from skillc_rdf.vocabulary.closure import reachable
from skillc_rdf.vocabulary.datatypes import value_type
from skillc_rdf.vocabulary.expressions import alternatives, complements, required_terms
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.iris import (
    ADDS,
    BUILT_IN,
    CLASS,
    DISJOINT,
    DOMAIN,
    EDITION,
    INVERSE,
    OWL,
    PROPERTY,
    RANGE,
    RDFS,
    RELATION,
    SKILLC,
    TYPE,
)
from skillc_rdf.vocabulary.places import TermPositions
from skillc_rdf.vocabulary.types import THING, ClassTerm, PropertyTerm, RelationTerm, Signature, Vocabulary

COMMENT, REPLACED = f"{RDFS}comment", "http://purl.org/dc/terms/isReplacedBy"


class Terms(msgspec.Struct, frozen=True):
    """All terms with their kinds, super-terms and aliases, the shipped ones (`standing`), and their positions."""

    graph: Graph
    kinds: Mapping[str, str]
    below: Mapping[str, set[str]]
    aliases: Mapping[str, str]
    standing: frozenset[str]
    places: TermPositions

    def of(self, kind: str) -> Iterator[str]:
        """Yield the terms of a kind without aliases, sorted."""
        yield from (iri for iri in sorted(self.kinds) if self.kinds[iri] == kind and iri not in self.aliases)

    def named(self, iri: str) -> str:
        """Return the term that an IRI stands for."""
        return self.aliases.get(iri, iri)

    def same(self, iri: str) -> list[str]:
        """Return all names of a term, its own first."""
        return [iri, *(alias for alias, term in self.aliases.items() if term == iri)]

    def above(self, iri: str) -> tuple[str, ...]:
        """Return the direct super-terms of a term, sorted."""
        found = {self.named(other) for name in self.same(iri) for other in self.below.get(name, ())}
        return tuple(sorted(other for other in found - {iri, THING} if self.kinds.get(other) == self.kinds[iri]))

    def ancestors(self, iri: str) -> frozenset[str]:
        """Return all super-terms of a term, itself not included."""
        return frozenset(reachable(self.above(iri), self.above))


def make_classes(terms: Terms) -> dict[str, ClassTerm]:
    """Return the classes."""
    disjoint = _disjoint(terms)
    return {
        iri: ClassTerm(
            iri=iri,
            parents=terms.above(iri),
            disjoint=tuple(sorted(disjoint[iri])),
            required=_required(terms, iri),
            comment=terms.graph.text(iri, COMMENT) or "",
            source=terms.places.position(iri),
        )
        for iri in terms.of(CLASS)
    }


def find_individuals(triples: Iterable[ox.Triple], vocabulary: Vocabulary) -> dict[str, tuple[str, ...]]:
    """Return the individuals that triples say to be of classes of the vocabulary, with these classes, sorted by IRI."""
    found = defaultdict[str, set[str]](set)
    for each in triples:
        subject, cls = each.subject, each.object
        if each.predicate.value == TYPE and isinstance(subject, ox.NamedNode) and isinstance(cls, ox.NamedNode):
            named = vocabulary.aliases.get(cls.value, cls.value)
            if named in vocabulary.classes and not _is_term(subject.value, vocabulary):
                found[subject.value].add(named)
    return {iri: tuple(sorted(found[iri])) for iri in sorted(found)}


def _is_term(iri: str, vocabulary: Vocabulary) -> bool:
    terms = (vocabulary.classes, vocabulary.relations, vocabulary.properties, vocabulary.aliases)
    return any(iri in each for each in terms)


def find_idle(terms: Terms, vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return the relations and properties that are not shipped, sorted; there are none if all are."""
    every = (*vocabulary.relations, *vocabulary.properties) if terms.standing else ()
    return tuple(sorted(each for each in every if each not in terms.standing))


def with_named(vocabulary: Vocabulary, named: Collection[str]) -> Vocabulary:
    """Return a vocabulary of whose idle terms those that are `named`, or imply a relation that is, are idle no more."""
    implied = vocabulary.super_relations
    read = {each for each in vocabulary.idle if not implied.get(each, frozenset((each,))).isdisjoint(named)}
    if not read:
        return vocabulary
    return msgspec.structs.replace(vocabulary, idle=tuple(each for each in vocabulary.idle if each not in read))


def make_relations(terms: Terms) -> dict[str, RelationTerm]:
    """Return the relations."""
    inverse = find_inverses(terms)
    return {iri: _relation(terms, iri, inverse.get(iri)) for iri in terms.of(RELATION)}


def make_properties(terms: Terms) -> dict[str, PropertyTerm]:
    """Return the data properties that have a type in the language."""
    found: dict[str, PropertyTerm] = {}
    for iri in terms.of(PROPERTY):
        typed = value_type(terms.graph, iri)
        if typed is not None:
            found[iri] = PropertyTerm(
                iri=iri,
                domains=_ends(terms, iri, DOMAIN) or (THING,),
                type=typed.type,
                values=typed.values,
                bounds=typed.bounds,
                datatype=typed.datatype,
                functional=_is(terms, iri, "FunctionalProperty"),
                computed_by=terms.graph.text(iri, f"{SKILLC}computedBy"),
                computed_from=_computed_from(terms, iri),
                measure=_other_property(terms, iri, "measure"),
                threshold=_other_property(terms, iri, "threshold"),
                comment=terms.graph.text(iri, COMMENT) or "",
                source=terms.places.position(iri),
            )
    return found


def _computed_from(terms: Terms, iri: str) -> tuple[str, ...]:
    return tuple(sorted(map(terms.named, terms.graph.iris(iri, f"{SKILLC}computedFrom"))))


def _other_property(terms: Terms, iri: str, annotation: str) -> str | None:
    """Return the first property that an annotation of a property names; None if it names none."""
    named = map(terms.named, terms.graph.iris(iri, f"{SKILLC}{annotation}"))
    return next((each for each in sorted(named) if terms.kinds.get(each) == PROPERTY), None)


def find_deprecated(terms: Terms) -> dict[str, str]:
    """Return the deprecated terms with their replacements, "" without one."""
    marked = (iri for iri in sorted(terms.kinds) if terms.graph.text(iri, f"{OWL}deprecated") in ("true", "1"))
    return {iri: next(iter(terms.graph.iris(iri, REPLACED)), "") for iri in marked}


def find_editions(graph: Graph) -> dict[str, int]:
    """Return the terms that came after the first edition of the language, with the edition of each."""
    editions = {each: int(graph.text(each, EDITION) or 0) for each in graph.subjects(EDITION)}
    return {iri: number for each, number in sorted(editions.items()) for iri in sorted(graph.iris(each, ADDS))}


def _required(terms: Terms, iri: str) -> tuple[str, ...]:
    """Return the relations and properties that a class requires; aliases of a shipped class add none."""
    names = [iri] if iri in terms.standing else terms.same(iri)
    found = {each for name in names for each in required_terms(terms.graph, name, terms.aliases)}
    return tuple(sorted(each for each in found if _is_usable(terms, each)))


def _is_usable(terms: Terms, iri: str) -> bool:
    kind = terms.kinds.get(iri)
    return kind == RELATION or (kind == PROPERTY and value_type(terms.graph, iri) is not None)


def _disjoint(terms: Terms) -> dict[str, set[str]]:
    graph, disjoint = terms.graph, defaultdict[str, set[str]](set)
    for iri in terms.of(CLASS):
        for name in terms.same(iri):
            stated = {*graph.iris(name, DISJOINT), *complements(graph, name)}
            disjoint[iri].update(terms.named(other) for other in stated if terms.kinds.get(other) == CLASS)
    for members in _lists(graph):
        for one, other in combinations([terms.named(each) for each in members], 2):
            if not {one, other} <= terms.standing or terms.standing.issuperset(members):
                disjoint[one].add(other)
    return disjoint


def _lists(graph: Graph) -> Iterator[list[str]]:
    """Yield the lists of pairwise disjoint classes."""
    heads = [
        head for axiom in graph.nodes(f"{OWL}AllDisjointClasses") for head in graph.objects(axiom, f"{OWL}members")
    ]
    heads += [h for iri in graph.subjects(f"{OWL}disjointUnionOf") for h in graph.objects(iri, f"{OWL}disjointUnionOf")]
    for head in heads:
        yield [member.value for member in graph.members(head) if isinstance(member, ox.NamedNode)]


def find_inverses(terms: Terms) -> dict[str, str]:
    """Return the inverse of each relation that has one; if several relations name the same inverse, each has it."""
    stated: dict[str, str] = {}
    reverse: dict[str, str] = {}
    for iri in terms.of(RELATION):
        others = sorted({terms.named(o) for name in terms.same(iri) for o in terms.graph.iris(name, INVERSE)})
        for other in (each for each in others if terms.kinds.get(each) == RELATION):
            stated.setdefault(iri, other)
            reverse.setdefault(other, iri)
    return {**reverse, **stated}


def _relation(terms: Terms, iri: str, inverse: str | None) -> RelationTerm:
    return RelationTerm(
        iri=iri,
        signatures=_signatures(terms, iri, inverse),
        parents=terms.above(iri),
        inverse=inverse,
        functional=_is(terms, iri, "FunctionalProperty"),
        inverse_functional=_is(terms, iri, "InverseFunctionalProperty"),
        symmetric=_is(terms, iri, "SymmetricProperty"),
        transitive=_is(terms, iri, "TransitiveProperty"),
        asymmetric=_is(terms, iri, "AsymmetricProperty"),
        irreflexive=_is(terms, iri, "IrreflexiveProperty"),
        acyclic=terms.graph.text(iri, f"{SKILLC}acyclic") == "true",
        computed_by=terms.graph.text(iri, f"{SKILLC}computedBy"),
        computed_from=_computed_from(terms, iri),
        comment=terms.graph.text(iri, COMMENT) or "",
        source=terms.places.position(iri),
    )


def _signatures(terms: Terms, iri: str, inverse: str | None) -> tuple[Signature, ...]:
    """Return the signatures; a relation without domain and range has those of its inverse, exchanged."""
    domains, ranges = _ends(terms, iri, DOMAIN), _ends(terms, iri, RANGE)
    if inverse and not domains and not ranges:
        domains, ranges = _ends(terms, inverse, RANGE), _ends(terms, inverse, DOMAIN)
    return tuple(Signature(domain, range_) for domain in domains or (THING,) for range_ in ranges or (THING,))


def _ends(terms: Terms, iri: str, predicate: str) -> tuple[str, ...]:
    """Return the classes in a domain or range, sorted; () if it is unrestricted.

    Of several named classes all apply, so those above others among them are redundant.
    """
    found = {terms.named(cls) for cls in alternatives(terms.graph, iri, predicate)}
    named = {terms.named(cls) for cls in terms.graph.iris(iri, predicate)}
    wider = named & {above for cls in named for above in terms.ancestors(cls) - {cls}}
    kept = {cls for cls in found - wider if not cls.startswith(BUILT_IN)}
    return tuple(sorted(kept))


def _is(terms: Terms, iri: str, characteristic: str) -> bool:
    return f"{OWL}{characteristic}" in terms.graph.iris(iri, TYPE)
