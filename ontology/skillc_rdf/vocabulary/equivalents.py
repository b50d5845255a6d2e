"""Finds equivalent terms: those declared equivalent and those in cycles of sub-terms. One represents the others."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple, TypeAlias

from skillc_dsl.diagnostics import Diagnostic
from skillc_rdf.vocabulary.components import components
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.iris import EQUAL_CLASS, EQUAL_PROPERTY, SKILLC
from skillc_rdf.vocabulary.places import TermPositions

Edges: TypeAlias = Mapping[str, Iterable[str]]


class Equivalents(NamedTuple):
    """The aliases of terms, and the cycles of sub-terms that are not declared equivalent."""

    aliases: dict[str, str]
    circles: tuple[tuple[str, ...], ...]


def find_equivalents(graph: Graph, kinds: Mapping[str, str], below: Edges, standing: frozenset[str]) -> Equivalents:
    """Find the equivalent terms. `kinds` are all terms, `below` their super-terms, `standing` the shipped terms.

    The representative is the shipped term, else the first by IRI. Terms that would make two shipped terms equivalent
    are not merged.
    """
    said = {iri: [o for p in (EQUAL_CLASS, EQUAL_PROPERTY) for o in graph.iris(iri, p) if o in kinds] for iri in kinds}
    both: dict[str, set[str]] = {iri: set() for iri in kinds}
    for iri in kinds:
        for other in said[iri]:
            both[iri].add(other)
            both[other].add(iri)
        both[iri].update(other for other in below.get(iri, ()) if other in kinds)
    aliases: dict[str, str] = {}
    circles: list[tuple[str, ...]] = []
    for group in components({iri: sorted(both[iri]) for iri in sorted(both)}):
        if len(group) < 2:
            continue
        shipped = [iri for iri in group if iri in standing]
        if len(shipped) > 1 or len({kinds[iri] for iri in group}) > 1:
            continue
        first = shipped[0] if shipped else min(group)
        aliases |= {iri: first for iri in group if iri != first}
        if not any(said[iri] for iri in group):
            circles.append(tuple(sorted(group)))
    named = {iri: others[0] for iri in kinds if (others := graph.iris(iri, f"{SKILLC}aliasOf"))}
    return Equivalents(dict(sorted({**aliases, **named}.items())), tuple(circles))


def report_cycles(
    circles: Iterable[tuple[str, ...]], below: Edges, places: TermPositions, predicate: str, short: Callable[[str], str]
) -> Iterator[Diagnostic]:
    """Report cycles of sub-terms."""
    for circle in circles:
        first = circle[0]
        others = ", ".join(f"`{short(each)}`" for each in circle[1:])
        after = next(iter(sorted(set(below[first]) & set(circle) - {first})), None)
        yield Diagnostic(
            "class-cycle",
            places.statement(first, predicate, after),
            f"`{short(first)}` is below itself through {others}; they are treated as equivalent",
            help="remove one of the axioms, or declare them equivalent with `owl:equivalentClass`",
            severity="warning",
        )
