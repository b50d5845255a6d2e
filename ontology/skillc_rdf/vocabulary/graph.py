"""A graph of triples with the look-ups that loading a vocabulary needs."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence

import pyoxigraph as ox

RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
Node = ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple


class Graph:
    """Triples, indexed by subject and predicate."""

    def __init__(self, triples: Iterable[ox.Triple] = ()) -> None:
        self._objects: dict[tuple[Node, str], list[Node]] = defaultdict(list)
        self._subjects: dict[str, dict[Node, None]] = defaultdict(dict)
        self._instances: dict[str, list[Node]] = defaultdict(list)
        self._about: dict[Node, list[ox.Triple]] = defaultdict(list)
        self.add(triples)

    def add(self, triples: Iterable[ox.Triple]) -> None:
        """Add triples."""
        for triple in triples:
            self._objects[triple.subject, triple.predicate.value].append(triple.object)
            self._subjects[triple.predicate.value][triple.subject] = None
            if isinstance(triple.subject, ox.BlankNode):
                self._about[triple.subject].append(triple)
            if triple.predicate.value == f"{RDF}type" and isinstance(triple.object, ox.NamedNode):
                self._instances[triple.object.value].append(triple.subject)

    def instances(self, cls: str) -> tuple[str, ...]:
        """Return the IRIs declared to be of exactly this class, sorted."""
        return tuple(sorted({node.value for node in self._instances[cls] if isinstance(node, ox.NamedNode)}))

    def kinds(self) -> tuple[str, ...]:
        """Return the classes of which anything is declared to be, sorted."""
        return tuple(sorted(self._instances))

    def nodes(self, cls: str) -> tuple[Node, ...]:
        """Return everything declared to be of exactly this class, blank nodes too, in order of appearance."""
        return tuple(self._instances[cls])

    def subjects(self, predicate: str) -> tuple[str, ...]:
        """Return the IRIs that are subjects of a predicate, sorted."""
        return tuple(sorted(node.value for node in self._subjects[predicate] if isinstance(node, ox.NamedNode)))

    def objects(self, subject: Node | str, predicate: str) -> tuple[Node, ...]:
        """Return the objects in order of appearance."""
        node = ox.NamedNode(subject) if isinstance(subject, str) else subject
        return tuple(self._objects.get((node, predicate), ()))

    def about(self, node: Node) -> Sequence[ox.Triple]:
        """Return the triples of a blank node, in order of appearance."""
        return self._about.get(node, ())

    def iris(self, subject: Node | str, predicate: str) -> tuple[str, ...]:
        """Return those objects that are IRIs, sorted and without repetition."""
        return tuple(sorted({o.value for o in self.objects(subject, predicate) if isinstance(o, ox.NamedNode)}))

    def text(self, subject: Node | str, predicate: str) -> str | None:
        """Return the text of the first object that is a literal, None without one."""
        return next((o.value for o in self.objects(subject, predicate) if isinstance(o, ox.Literal)), None)

    def members(self, head: Node) -> Iterator[Node]:
        """Yield the members of an RDF list, up to the end or to where it is broken or cyclic."""
        seen: set[Node] = set()
        while head not in seen and (values := self.objects(head, f"{RDF}first")):
            seen.add(head)
            yield values[0]
            head = next(iter(self.objects(head, f"{RDF}rest")), ox.NamedNode(f"{RDF}nil"))
