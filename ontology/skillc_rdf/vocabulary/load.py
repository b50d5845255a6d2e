"""Loads the texts of ontologies as a Vocabulary: classes, relations and properties with their axioms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.source import Source, Span
from skillc_rdf.vocabulary.axioms.rules import Rules
from skillc_rdf.vocabulary.axioms.unused import report_missing_imports, report_unused_axioms
from skillc_rdf.vocabulary.conflicts import with_concerned
from skillc_rdf.vocabulary.contradictions import report_contradictions
from skillc_rdf.vocabulary.datatypes import check_value_types
from skillc_rdf.vocabulary.equivalents import find_equivalents, report_cycles
from skillc_rdf.vocabulary.expressions import subclasses, superclasses
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.iris import CLASS, KINDS, PROPERTY, SUBCLASS, SUBPROPERTY
from skillc_rdf.vocabulary.kinds import find_undeclared, infer_declarations
from skillc_rdf.vocabulary.lints import check_computed_relations, lint_ontology
from skillc_rdf.vocabulary.places import TermPositions
from skillc_rdf.vocabulary.precedence import LISTED, Split, report_ignored, split_statements
from skillc_rdf.vocabulary.prefixes import choose_prefixes, preferred_prefixes, report_taken_prefixes
from skillc_rdf.vocabulary.reading import Ontology, read_ontologies
from skillc_rdf.vocabulary.terms import (
    Terms,
    find_deprecated,
    find_editions,
    find_idle,
    find_individuals,
    make_classes,
    make_properties,
    make_relations,
)
from skillc_rdf.vocabulary.types import Vocabulary


def load(sources: Sequence[Source], own: Sequence[Source] = ()) -> Outcome[Vocabulary]:
    """Load the shipped ontologies `sources`, and the user's, `own`, which cannot change the terms of the former.

    Diagnostics: unreadable files, conflicts, which count only where they are used (`judge_conflicts`), and for `own`
    also axioms without effect.
    """
    shipped, theirs = read_ontologies(sources), read_ontologies(own)
    standing = frozenset(iri for each in shipped.value for iri in _terms(Graph(each.triples))) if own else frozenset()
    parts = [split_statements(each, shipped.value, standing) for each in theirs.value]
    graph = Graph(triple for each in shipped.value for triple in each.triples)
    known = preferred_prefixes(graph)
    graph.add(triple for part in parts for triple in part.counting)
    assumed = infer_declarations(graph, [triple for part in parts for triple in part.counting])
    new = find_undeclared(graph, assumed)
    graph.add(assumed)
    places = TermPositions(each.source for each in (*shipped.value, *theirs.value))
    understood = _vocabulary(graph, places, standing, choose_prefixes(graph, theirs.value, known))
    counting = tuple(triple for part in parts for triple in part.counting)
    rules = Rules(counting, graph)
    vocabulary = replace(understood.value, individuals=find_individuals(counting, understood.value), rules=rules.lines)
    problems = (
        *(*shipped.diagnostics, *theirs.diagnostics, *report_taken_prefixes(theirs.value, known)),
        *(*understood.diagnostics, *_undeclared(new, places, understood.value)),
        *_of_files(theirs.value, parts, graph, rules, understood.value),
    )
    return Outcome(vocabulary, problems)


def _vocabulary(
    graph: Graph, places: TermPositions, standing: frozenset[str], prefixes: dict[str, str]
) -> Outcome[Vocabulary]:
    kinds = _terms(graph)
    below = _below(graph, kinds)
    same = find_equivalents(graph, kinds, below, standing)
    terms = Terms(graph, kinds, below, same.aliases, standing, places)
    vocabulary = Vocabulary(
        prefixes=prefixes,
        aliases=same.aliases,
        deprecated=find_deprecated(terms),
        since=find_editions(graph),
        classes=make_classes(terms),
        relations=make_relations(terms),
        properties=make_properties(terms),
    )
    circles = [each for each in same.circles if kinds[each[0]] == CLASS]
    others = [each for each in same.circles if kinds[each[0]] != CLASS]
    vocabulary = replace(vocabulary, idle=find_idle(terms, vocabulary))
    problems = (
        *check_value_types(graph, [iri for iri, kind in kinds.items() if kind == PROPERTY], places.terms),
        *report_cycles(circles, below, places, SUBCLASS, vocabulary.short),
        *report_cycles(others, below, places, SUBPROPERTY, vocabulary.short),
        *check_computed_relations(vocabulary),
        *report_contradictions(graph, vocabulary, places),
        *lint_ontology(graph, vocabulary, places),
    )
    return Outcome(vocabulary, with_concerned(problems, graph, vocabulary))


def _terms(graph: Graph) -> dict[str, str]:
    """Return all terms with their kinds; for a term of several kinds the first of KINDS."""
    return {iri: kind for kind in reversed(KINDS) for iri in graph.instances(kind)}


def _below(graph: Graph, kinds: dict[str, str]) -> dict[str, set[str]]:
    """Return the direct super-terms of each term, by its own declaration or as the member of a union."""
    below: dict[str, set[str]] = {}
    for iri, kind in kinds.items():
        above = superclasses(graph, iri) if kind == CLASS else set(graph.iris(iri, SUBPROPERTY))
        below[iri] = {other for other in above if other in kinds and other != iri}
    for iri, kind in kinds.items():
        for member in subclasses(graph, iri) if kind == CLASS else ():
            if member in kinds and member != iri:
                below[member].add(iri)
    return below


def _undeclared(
    terms: Sequence[tuple[str, str]], places: TermPositions, vocabulary: Vocabulary
) -> Iterator[Diagnostic]:
    """Yield a warning for each undeclared term, or one for all of a file that has many."""
    found: dict[str, list[tuple[Span, str, str]]] = {}
    for iri, kind in terms:
        place = places.term(iri)
        found.setdefault(place.path, []).append((place, f"`{vocabulary.short(iri)}`", kind))
    for of_file in found.values():
        if len(of_file) > LISTED:
            names = ", ".join(name for _, name, _ in of_file[:LISTED])
            said = f"{names} and {len(of_file) - LISTED} more are used but not declared; what they are is assumed"
            yield _undeclared_at(min(place for place, _, _ in of_file), said)
            continue
        for place, name, kind in of_file:
            yield _undeclared_at(place, f"{name} is used but not declared; it is assumed to be a {kind}")


def _undeclared_at(place: Span, message: str) -> Diagnostic:
    help_ = "declare it, or put the file that declares it into the same folder"
    return Diagnostic("undeclared-term", place, message, help_, severity="warning")


def _of_files(
    own: Sequence[Ontology], parts: Sequence[Split], graph: Graph, rules: Rules, vocabulary: Vocabulary
) -> Iterator[Diagnostic]:
    yield from report_missing_imports(own, graph)
    yield from report_ignored(parts, vocabulary)
    yield from report_unused_axioms(parts, graph, rules)
