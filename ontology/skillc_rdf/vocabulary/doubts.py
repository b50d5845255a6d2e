"""Tells of what a vocabulary may say and hardly means: two inverses, two domains at once, axioms beyond OWL 2 DL."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations

from skillc_dsl.diagnostics import Diagnostic
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.names import DOMAIN, INVERSE, RANGE, TYPE
from skillc_rdf.vocabulary.places import Places
from skillc_rdf.vocabulary.types import PropertyTerm, RelationTerm, Vocabulary


def doubts(graph: Graph, vocabulary: Vocabulary, places: Places) -> Iterator[Diagnostic]:
    """Yield what is doubtful; an error where no reading makes sense."""
    yield from _inverses(graph, vocabulary, places)
    for iri in (*vocabulary.relations, *vocabulary.properties):
        yield from _domains(graph, vocabulary, iri, places)
    yield from _beyond_dl(vocabulary, places)


def _inverses(graph: Graph, vocabulary: Vocabulary, places: Places) -> Iterator[Diagnostic]:
    known, named = vocabulary.relations, vocabulary.aliases.get
    of: dict[str, set[str]] = {iri: set() for iri in known}
    for iri in graph.subjects(INVERSE):
        for other in graph.iris(iri, INVERSE):
            one, two = named(iri, iri), named(other, other)
            if one in known and two in known:
                of[one].add(two)
                of[two].add(one)
    for iri, others in of.items():
        if len(others) > 1:
            *first, last = (f"`{vocabulary.short(each)}`" for each in sorted(others))
            message = f"{', '.join(first)} and {last} are inverses of `{vocabulary.short(iri)}`, so they mean the same"
            help_ = "keep one inverse, or call them equal: `owl:equivalentProperty`"
            yield Diagnostic(
                "several-inverses", places.statement(max(others), INVERSE), message, help_, severity="warning"
            )


def _domains(graph: Graph, vocabulary: Vocabulary, iri: str, places: Places) -> Iterator[Diagnostic]:
    """Tell of domains or ranges that hold at once in OWL and that are taken for alternatives here."""
    for predicate, word in ((DOMAIN, "domains"), (RANGE, "ranges")):
        if predicate == RANGE and iri in vocabulary.properties:
            continue
        stated = {vocabulary.aliases.get(each, each) for each in graph.iris(iri, predicate)}
        kept = sorted(stated & _ends(vocabulary.relations, vocabulary.properties, iri, predicate))
        if len(kept) > 1:
            both = " and ".join(f"`{vocabulary.short(each)}`" for each in kept)
            place, short = places.statement(iri, predicate, kept[-1]), vocabulary.short(iri)
            help_ = "write `[ a owl:Class ; owl:unionOf ( .. ) ]` for either, or name a class below both"
            if any(vocabulary.disjoint(*pair) for pair in combinations(kept, 2)):
                message = f"`{short}` can hold of nothing: its {word} are {both}, at once, and nothing is both"
                yield Diagnostic("impossible-relation", place, message, help_)
            else:
                message = f"the {word} of `{short}` are {both}: in OWL both at once, here either"
                yield Diagnostic("several-domains", place, message, help_, severity="warning")


def _ends(
    relations: Mapping[str, RelationTerm], properties: Mapping[str, PropertyTerm], iri: str, predicate: str
) -> set[str]:
    if iri in properties:
        return set(properties[iri].domains)
    return {each.domain if predicate == DOMAIN else each.range for each in relations[iri].signatures}


def _beyond_dl(vocabulary: Vocabulary, places: Places) -> Iterator[Diagnostic]:
    """Tell of characteristics that OWL 2 DL forbids for relations that a transitive one implies."""
    relations = vocabulary.relations
    for iri in sorted(vocabulary.closure.chained):
        words = [each for each in relations[iri].characteristics if each not in ("symmetric", "transitive")]
        if words:
            yield Diagnostic(
                "beyond-owl-dl",
                places.statement(iri, TYPE),
                f"`{vocabulary.short(iri)}` is {' and '.join(words)}, and it or one below it is transitive",
                help="OWL 2 DL forbids that and reasoners refuse it; make a relation above it the transitive one",
                severity="warning",
            )
