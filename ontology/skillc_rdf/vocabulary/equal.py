"""Which terms are one by what an ontology says: called equal, or each below the other. One of them stands for all."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeAlias

from skillc_dsl.diagnostics import Diagnostic
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.names import EQUAL_CLASS, EQUAL_PROPERTY, SKILLC
from skillc_rdf.vocabulary.places import Places

Edges: TypeAlias = Mapping[str, Iterable[str]]


class Equal(NamedTuple):
    """Other names of terms, and the circles of terms that are below each other without being called equal."""

    aliases: dict[str, str]
    circles: tuple[tuple[str, ...], ...]


def equal(graph: Graph, kinds: Mapping[str, str], below: Edges, standing: frozenset[str]) -> Equal:
    """Find the terms that are one; `kinds` are all terms, `below` what each is below, `standing` those skillc ships.

    A shipped term stands for the others, else the first. Terms that would make two shipped ones equal keep apart.
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
    for group in _components(both):
        shipped = [iri for iri in group if iri in standing]
        if len(shipped) > 1 or len({kinds[iri] for iri in group}) > 1:
            continue
        first = shipped[0] if shipped else min(group)
        aliases |= {iri: first for iri in group if iri != first}
        if not any(said[iri] for iri in group):
            circles.append(tuple(sorted(group)))
    named = {iri: others[0] for iri in kinds if (others := graph.iris(iri, f"{SKILLC}aliasOf"))}
    return Equal(dict(sorted({**aliases, **named}.items())), tuple(circles))


def circles_told(
    circles: Iterable[tuple[str, ...]], below: Edges, places: Places, predicate: str, short: Callable[[str], str]
) -> Iterator[Diagnostic]:
    """Tell of terms that are below each other."""
    for circle in circles:
        first = circle[0]
        others = ", ".join(f"`{short(each)}`" for each in circle[1:])
        after = next(iter(sorted(set(below[first]) & set(circle) - {first})), None)
        yield Diagnostic(
            "class-cycle",
            places.statement(first, predicate, after),
            f"`{short(first)}` is below itself, by {others}; they are taken for one",
            help="take one of them from below the other, or call them equal: `owl:equivalentClass`",
            severity="warning",
        )


def _components(edges: Mapping[str, set[str]]) -> Iterator[Sequence[str]]:
    """Yield the strongly connected components that have more than one member (Tarjan, without recursion)."""
    number: dict[str, int] = {}
    low: dict[str, int] = {}
    path: list[str] = []
    on_path: set[str] = set()
    for root in sorted(edges):
        todo = [(root, iter(sorted(edges[root])))] if root not in number else []
        while todo:
            node, others = todo[-1]
            if node not in number:
                number[node] = low[node] = len(number)
                path.append(node)
                on_path.add(node)
            other = next(others, None)
            if other is None:
                todo.pop()
                if todo:
                    low[todo[-1][0]] = min(low[todo[-1][0]], low[node])
                yield from _closed(node, number, low, path, on_path)
            elif other not in number:
                todo.append((other, iter(sorted(edges[other]))))
            elif other in on_path:
                low[node] = min(low[node], number[other])


def _closed(
    node: str, number: Mapping[str, int], low: Mapping[str, int], path: list[str], on_path: set[str]
) -> Iterator[Sequence[str]]:
    """Take a component off the path when its first node is left; yield it if it has more than one member."""
    if low[node] != number[node]:
        return
    found: list[str] = []
    while not found or found[-1] != node:
        found.append(path.pop())
        on_path.discard(found[-1])
    if len(found) > 1:
        yield found
