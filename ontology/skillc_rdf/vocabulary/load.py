"""From the texts of ontologies to a Vocabulary: classes, relations and properties with their axioms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.computed import computed_alone
from skillc_rdf.vocabulary.contradictions import contradictions
from skillc_rdf.vocabulary.datatypes import value_types_known
from skillc_rdf.vocabulary.doubts import doubts
from skillc_rdf.vocabulary.equal import circles_told, equal
from skillc_rdf.vocabulary.expressions import subclasses, superclasses
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.kinds import declarations, undeclared
from skillc_rdf.vocabulary.names import CLASS, KINDS, PROPERTY, SUBCLASS, SUBPROPERTY
from skillc_rdf.vocabulary.places import Places
from skillc_rdf.vocabulary.precedence import Split, passed_over, split
from skillc_rdf.vocabulary.prefixes import preferred, prefixes, taken
from skillc_rdf.vocabulary.reading import Ontology, read
from skillc_rdf.vocabulary.terms import Terms, classes, deprecated, properties, relations
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_rdf.vocabulary.unused import imports, unused


def load(sources: Sequence[Source], own: Sequence[Source] = ()) -> Outcome[Vocabulary]:
    """Read vocabularies: `sources`, and beside them `own`, in which the terms of the former cannot be changed.

    Diagnostics: files that cannot be read, contradictions, and of `own` also whatever is not used.
    """
    shipped, theirs = read(sources), read(own)
    standing = frozenset(iri for each in shipped.value for iri in _terms(Graph(each.triples))) if own else frozenset()
    parts = [split(each, shipped.value, standing) for each in theirs.value]
    graph = Graph(triple for each in shipped.value for triple in each.triples)
    known = preferred(graph)
    graph.add(triple for part in parts for triple in part.counting)
    assumed = declarations(graph, [triple for part in parts for triple in part.counting])
    new = undeclared(graph, assumed)
    graph.add(assumed)
    places = Places(each.source for each in (*shipped.value, *theirs.value))
    understood = _vocabulary(graph, places, standing, prefixes(graph, theirs.value, known))
    problems = (
        *(*shipped.diagnostics, *theirs.diagnostics, *taken(theirs.value, known)),
        *(*understood.diagnostics, *_undeclared(new, places, understood.value)),
        *_of_files(theirs.value, parts, graph, understood.value),
    )
    return Outcome(understood.value, problems)


def _vocabulary(
    graph: Graph, places: Places, standing: frozenset[str], prefixes: dict[str, str]
) -> Outcome[Vocabulary]:
    kinds = _terms(graph)
    below = _below(graph, kinds)
    same = equal(graph, kinds, below, standing)
    terms = Terms(graph, kinds, below, same.aliases, standing, places)
    vocabulary = Vocabulary(
        prefixes=prefixes,
        aliases=same.aliases,
        deprecated=deprecated(terms),
        classes=classes(terms),
        relations=relations(terms),
        properties=properties(terms),
    )
    circles = [each for each in same.circles if kinds[each[0]] == CLASS]
    others = [each for each in same.circles if kinds[each[0]] != CLASS]
    problems = (
        *value_types_known(graph, [iri for iri, kind in kinds.items() if kind == PROPERTY], places.terms),
        *circles_told(circles, below, places, SUBCLASS, vocabulary.short),
        *circles_told(others, below, places, SUBPROPERTY, vocabulary.short),
        *computed_alone(vocabulary),
        *contradictions(graph, vocabulary, places),
        *doubts(graph, vocabulary, places),
    )
    return Outcome(vocabulary, problems)


def _terms(graph: Graph) -> dict[str, str]:
    """Return all terms with their kinds; one that is declared as several is of the first."""
    return {iri: kind for kind in reversed(KINDS) for iri in graph.instances(kind)}


def _below(graph: Graph, kinds: dict[str, str]) -> dict[str, set[str]]:
    """Return what each term is below of, by its own declaration or as the member of a union."""
    below: dict[str, set[str]] = {}
    for iri, kind in kinds.items():
        above = superclasses(graph, iri) if kind == CLASS else set(graph.iris(iri, SUBPROPERTY))
        below[iri] = {other for other in above if other in kinds and other != iri}
    for iri, kind in kinds.items():
        for member in subclasses(graph, iri) if kind == CLASS else ():
            if member in kinds and member != iri:
                below[member].add(iri)
    return below


def _undeclared(terms: Sequence[tuple[str, str]], places: Places, vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    for iri, kind in terms:
        yield Diagnostic(
            "undeclared-term",
            places.term(iri),
            f"`{vocabulary.short(iri)}` is used and nowhere declared; it is taken for a {kind}",
            help="declare it, or put the file that does into the same folder",
            severity="warning",
        )


def _of_files(
    own: Sequence[Ontology], parts: Sequence[Split], graph: Graph, vocabulary: Vocabulary
) -> Iterator[Diagnostic]:
    yield from imports(own, graph)
    yield from passed_over(parts, vocabulary)
    yield from unused(parts, graph)
