"""Lints of vocabularies: inverses, domains, measures and thresholds, axioms beyond OWL 2 DL."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.position import Position
from skillc_dsl.source import Span
from skillc_dsl.spelling import did_you_mean
from skillc_rdf.vocabulary.conflicts import Conflict
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.iris import DOMAIN, INVERSE, RANGE, SKILLC, TYPE
from skillc_rdf.vocabulary.places import TermPositions
from skillc_rdf.vocabulary.types import PropertyTerm, RelationTerm, Vocabulary


def lint_ontology(graph: Graph, vocabulary: Vocabulary, places: TermPositions) -> Iterator[Diagnostic]:
    """Report axioms that are valid but probably not meant; an error if a relation could never hold."""
    yield from _lint_inverses(graph, vocabulary, places)
    for iri in (*vocabulary.relations, *vocabulary.properties):
        yield from _lint_domains(graph, vocabulary, iri, places)
    for iri in vocabulary.properties:
        yield from _lint_numbers(graph, vocabulary, iri, places)
    yield from _lint_beyond_dl(vocabulary, places)


def _lint_inverses(graph: Graph, vocabulary: Vocabulary, places: TermPositions) -> Iterator[Diagnostic]:
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
            message = f"{', '.join(first)} and {last} are inverses of `{vocabulary.short(iri)}`, so they are equivalent"
            help_ = "keep one inverse, or declare them equivalent with `owl:equivalentProperty`"
            yield Diagnostic(
                "several-inverses", places.statement(max(others), INVERSE), message, help_, severity="warning"
            )


def _lint_domains(graph: Graph, vocabulary: Vocabulary, iri: str, places: TermPositions) -> Iterator[Diagnostic]:
    """Report several domains or ranges: in OWL all of them apply, here they are alternatives."""
    for predicate, word in ((DOMAIN, "domains"), (RANGE, "ranges")):
        if predicate == RANGE and iri in vocabulary.properties:
            continue
        stated = {vocabulary.aliases.get(each, each) for each in graph.iris(iri, predicate)}
        kept = sorted(stated & _ends(vocabulary.relations, vocabulary.properties, iri, predicate))
        if len(kept) > 1:
            both = " and ".join(f"`{vocabulary.short(each)}`" for each in kept)
            place, short = places.statement(iri, predicate, kept[-1]), vocabulary.short(iri)
            help_ = "write `[ a owl:Class ; owl:unionOf ( .. ) ]` for either, or name a class below both"
            if _are_two_disjoint(vocabulary, kept):
                message = f"`{short}` can never hold: its {word} are {both}, which are disjoint"
                others = {places.statement(iri, predicate, each) for each in kept[:-1]} - {place}
                labels = tuple(Label(each, "the other one") for each in sorted(others)[:1])
                yield Conflict("impossible-relation", place, message, help_, labels=labels, term=iri)
            else:
                message = f"the {word} of `{short}` are {both}: in OWL both apply, here either"
                yield Diagnostic("several-domains", place, message, help_, severity="warning")


def _lint_numbers(graph: Graph, vocabulary: Vocabulary, iri: str, places: TermPositions) -> Iterator[Diagnostic]:
    """Report the measure or threshold of a property that is no property: explanations would leave it out."""
    short, known = vocabulary.short, vocabulary.properties
    stated = [(word, each) for word in ("measure", "threshold") for each in graph.iris(iri, f"{SKILLC}{word}")]
    for word, each in stated:
        if vocabulary.aliases.get(each, each) not in known:
            place = places.statement(iri, f"{SKILLC}{word}", each)
            message = f"the {word} of `{short(iri)}`, `{short(each)}`, is no declared property"
            help_ = did_you_mean(short(each), map(short, known))
            yield Diagnostic("undeclared-term", place, message, help_, severity="warning")


def _are_two_disjoint(vocabulary: Vocabulary, classes: Sequence[str]) -> bool:
    """Whether two of the classes are disjoint; only those below a class that is disjoint with another are compared."""
    above = {cls: vocabulary.ancestors.get(cls, frozenset({cls})) for cls in classes}
    every = frozenset[str]().union(*above.values()) & vocabulary.classes.keys()
    apart = {other for cls in every for other in vocabulary.classes[cls].disjoint}
    one_side = [cls for cls in classes if not apart.isdisjoint(above[cls])]
    return any(vocabulary.disjoint(one, other) for one in one_side for other in classes if other != one)


def _ends(
    relations: Mapping[str, RelationTerm], properties: Mapping[str, PropertyTerm], iri: str, predicate: str
) -> set[str]:
    if iri in properties:
        return set(properties[iri].domains)
    return {each.domain if predicate == DOMAIN else each.range for each in relations[iri].signatures}


def _lint_beyond_dl(vocabulary: Vocabulary, places: TermPositions) -> Iterator[Diagnostic]:
    """Report characteristics that OWL 2 DL forbids for relations that a transitive one implies."""
    relations = vocabulary.relations
    for iri in sorted(vocabulary.closure.chained):
        words = [each for each in relations[iri].characteristics if each not in ("symmetric", "transitive")]
        if words:
            yield Diagnostic(
                "beyond-owl-dl",
                places.statement(iri, TYPE),
                f"`{vocabulary.short(iri)}` is {' and '.join(words)}, and it or one below it is transitive",
                help="OWL 2 DL forbids this and reasoners reject it; make a super-relation of it transitive instead",
                severity="warning",
            )


def check_computed_relations(vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Report computed relations with axioms, and those computed from unknown terms."""
    for _, term in sorted(vocabulary.relations.items()):
        if term.computed_by is None:
            continue
        short = vocabulary.short(term.iri)
        for axiom in _axioms(term, vocabulary):
            message = f"`{short}` is computed by {term.computed_by}, so it cannot be {axiom}"
            yield _error(term, message, "remove the axiom: the Python class alone decides whether the relation holds")
        for other in term.computed_from:
            if other not in vocabulary.relations and other not in vocabulary.properties:
                message = (
                    f"`{short}` is computed from `{vocabulary.short(other)}`, which is neither relation nor property"
                )
                yield _error(term, message, "name the relations and properties that decide whether it holds")


def _axioms(term: RelationTerm, vocabulary: Vocabulary) -> Iterator[str]:
    yield from term.characteristics
    yield from (f"a kind of `{vocabulary.short(parent)}`" for parent in term.parents)
    if term.inverse is not None:
        yield f"the inverse of `{vocabulary.short(term.inverse)}`"
    for iri, other in sorted(vocabulary.relations.items()):
        if term.iri in other.parents:
            yield f"what `{vocabulary.short(iri)}` is a kind of"


def _error(term: RelationTerm, message: str, help_: str) -> Diagnostic:
    place = term.source or Position(term.iri, 1, 1)
    return Diagnostic("computed-relation", Span(place.path, place.line, 1, place.line, 2), message, help=help_)
