"""Turtle texts as one graph that answers the few questions a vocabulary asks."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.source import Source, Span

RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
Node = ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple


class Graph:
    """Triples by subject and predicate; blank nodes of different files never meet."""

    def __init__(self) -> None:
        self._objects: dict[tuple[Node, str], list[Node]] = defaultdict(list)
        self._instances: dict[str, list[Node]] = defaultdict(list)

    def add(self, triples: Iterable[ox.Triple | ox.Quad]) -> None:
        """Take in triples."""
        for triple in triples:
            self._objects[triple.subject, triple.predicate.value].append(triple.object)
            if triple.predicate.value == f"{RDF}type" and isinstance(triple.object, ox.NamedNode):
                self._instances[triple.object.value].append(triple.subject)

    def instances(self, cls: str) -> tuple[str, ...]:
        """Return the IRIs declared to be of exactly this class, sorted."""
        return tuple(sorted({node.value for node in self._instances[cls] if isinstance(node, ox.NamedNode)}))

    def nodes(self, cls: str) -> tuple[Node, ...]:
        """Return everything declared to be of exactly this class, blank nodes too, in order of appearance."""
        return tuple(self._instances[cls])

    def objects(self, subject: Node | str, predicate: str) -> tuple[Node, ...]:
        """Return the objects in order of appearance."""
        node = ox.NamedNode(subject) if isinstance(subject, str) else subject
        return tuple(self._objects.get((node, predicate), ()))

    def iris(self, subject: Node | str, predicate: str) -> tuple[str, ...]:
        """Return those objects that are IRIs, sorted and without repetition."""
        return tuple(sorted({o.value for o in self.objects(subject, predicate) if isinstance(o, ox.NamedNode)}))

    def text(self, subject: Node | str, predicate: str) -> str | None:
        """Return the first object that is a literal, as text."""
        return next((o.value for o in self.objects(subject, predicate) if isinstance(o, ox.Literal)), None)

    def members(self, head: Node) -> Iterator[Node]:
        """Yield the members of an RDF list."""
        while values := self.objects(head, f"{RDF}first"):
            yield values[0]
            head = self.objects(head, f"{RDF}rest")[0]


def read(sources: Iterable[Source]) -> Outcome[Graph]:
    """Parse Turtle texts into one graph; a broken text is left out and reported with its line."""
    graph = Graph()
    problems: list[Diagnostic] = []
    for source in sources:
        try:
            graph.add(list(ox.parse(source.text, format=ox.RdfFormat.TURTLE)))
        except SyntaxError as error:
            problems.append(_broken(source, error))
    return Outcome(graph, tuple(problems))


def _broken(source: Source, error: SyntaxError) -> Diagnostic:
    line, column = error.lineno or 1, error.offset or 1
    reason = (error.msg or "not Turtle").rpartition(": ")[2]
    return Diagnostic(
        "broken-turtle",
        Span(source.path, line, column, error.end_lineno or line, error.end_offset or column + 1),
        f"this file is not Turtle: {reason}",
        help="mend the file; everything it says is ignored until then",
    )
