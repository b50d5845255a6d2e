"""Finds the axioms that classify individuals or derive relations between them, which an OWL RL reasoner applies.

These are definitions, axioms about expressions, what all members of a class have (a value, or values of a class only),
and chains of properties; of expressions those that OWL 2 RL has on the side from which something follows (W3C, OWL 2
Profiles, table 2: intersections, unions, listed individuals, some value, a given value).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import pyoxigraph as ox

from skillc_rdf.vocabulary.graph import Graph, Node
from skillc_rdf.vocabulary.iris import EQUAL_CLASS, OWL, SUBCLASS

CHAIN, ONE_OF, HAS_VALUE = f"{OWL}propertyChainAxiom", f"{OWL}oneOf", f"{OWL}hasValue"
ON_PROPERTY, SOME_VALUES, ALL_VALUES = f"{OWL}onProperty", f"{OWL}someValuesFrom", f"{OWL}allValuesFrom"
INTERSECTION, UNION = f"{OWL}intersectionOf", f"{OWL}unionOf"
DEEPEST = 20
"""How deep expressions are read."""


class Rules:
    """The rules among the axioms of a graph, in their order."""

    def __init__(self, triples: Iterable[ox.Triple], graph: Graph) -> None:
        self._graph = graph
        self._axioms = {each: None for each in triples if self._is_rule(each)}
        self._parts: dict[Node, None] = {}
        for each in self._axioms:
            for end in (each.subject, each.object):
                self._add_parts(end)

    def covers(self, triple: ox.Triple) -> bool:
        """Whether a statement is one of the rules, or part of one."""
        return triple in self._axioms or (isinstance(triple.subject, ox.BlankNode) and triple.subject in self._parts)

    def is_axiom(self, triple: ox.Triple) -> bool:
        """Whether a statement is one of the rules."""
        return triple in self._axioms

    @property
    def lines(self) -> tuple[str, ...]:
        """The rules in N-Triples, one statement a line; the same for the same axioms in the same order."""
        names = {node: f"_:r{number}" for number, node in enumerate(self._parts)}
        parts = (triple for node in self._parts for triple in self._graph.about(node))
        return tuple(
            f"{names.get(each.subject, each.subject)} {each.predicate} {names.get(each.object, each.object)} ."
            for each in (*self._axioms, *parts)
        )

    def _is_rule(self, triple: ox.Triple) -> bool:
        said, subject, object_ = triple.predicate.value, triple.subject, triple.object
        if said == CHAIN:
            links = tuple(self._graph.members(object_))
            return isinstance(subject, ox.NamedNode) and bool(links) and all(map(_is_named, links))
        if said == ONE_OF:
            return isinstance(subject, ox.NamedNode)
        if said == EQUAL_CLASS and isinstance(subject, ox.NamedNode):
            return isinstance(object_, ox.BlankNode) and not self._is_union(object_) and self._decides(object_)
        if said == SUBCLASS and isinstance(subject, ox.BlankNode):
            return self._decides(subject) and (_is_named(object_) or self._gives(object_))
        return said == SUBCLASS and isinstance(object_, ox.BlankNode) and self._gives(object_)

    def _is_union(self, node: Node) -> bool:
        """Whether an expression is a union of named classes, which are subclasses."""
        return all(
            _is_named(each) for head in self._graph.objects(node, UNION) for each in self._graph.members(head)
        ) and bool(self._graph.objects(node, UNION))

    def _decides(self, node: Node, depth: int = 0) -> bool:
        """Whether it can be derived that something belongs to an expression."""
        if isinstance(node, ox.NamedNode):
            return True
        graph = self._graph
        if depth > DEEPEST or not isinstance(node, ox.BlankNode):
            return False
        for predicate in (INTERSECTION, UNION):
            for head in graph.objects(node, predicate):
                members = tuple(graph.members(head))
                return bool(members) and all(self._decides(each, depth + 1) for each in members)
        if graph.objects(node, ONE_OF):
            return all(map(_is_named, self._listed(node)))
        if not all(map(_is_named, graph.objects(node, ON_PROPERTY))):
            return False
        fillers = graph.objects(node, SOME_VALUES)
        return bool(graph.objects(node, HAS_VALUE)) or (
            bool(fillers) and all(self._decides(each, depth + 1) for each in fillers)
        )

    def _gives(self, node: Node) -> bool:
        """Whether something follows for a member of an expression that nothing else here derives."""
        graph = self._graph
        if not isinstance(node, ox.BlankNode) or not all(map(_is_named, graph.objects(node, ON_PROPERTY))):
            return False
        return bool(graph.objects(node, HAS_VALUE)) or any(map(_is_named, graph.objects(node, ALL_VALUES)))

    def _listed(self, node: Node) -> Iterator[Node]:
        for head in self._graph.objects(node, ONE_OF):
            yield from self._graph.members(head)

    def _add_parts(self, node: Node) -> None:
        """Add an expression or a list, and those in it."""
        todo = [node]
        while todo:
            part = todo.pop()
            if isinstance(part, ox.BlankNode) and part not in self._parts:
                self._parts[part] = None
                todo += [each.object for each in self._graph.about(part)]


def split_rules(lines: Iterable[ox.Triple]) -> tuple[tuple[ox.Triple, ...], ...]:
    """Return the statements of rules by axiom: its head, then the parts of its expressions."""
    statements = tuple(lines)
    about: dict[Node, list[ox.Triple]] = {}
    for each in statements:
        about.setdefault(each.subject, []).append(each)
    heads = [each for each in statements if _is_named(each.subject) or each.predicate.value == SUBCLASS]
    return tuple((head, *_parts_of(head, about)) for head in dict.fromkeys(heads))


def _parts_of(head: ox.Triple, about: Mapping[Node, Sequence[ox.Triple]]) -> Iterator[ox.Triple]:
    todo, seen = [head.subject, head.object], set[Node]()
    while todo:
        node = todo.pop()
        if isinstance(node, ox.BlankNode) and node not in seen:
            seen.add(node)
            parts = [each for each in about.get(node, ()) if each.predicate.value != SUBCLASS]
            yield from parts
            todo += [each.object for each in parts]


def _is_named(node: Node) -> bool:
    return isinstance(node, ox.NamedNode)
