"""Infers the kinds (class, relation, property) of terms that a user's ontologies do not declare properly.

Existing ontologies write `owl:class`, state characteristics of a property but not its kind, or use terms of files that
are missing. The kinds of such terms are inferred from their use.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence

import pyoxigraph as ox

from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.iris import (
    ANNOTATION,
    BUILT_IN,
    CLASS,
    COMPLEMENT,
    DATATYPE,
    DISJOINT,
    DOMAIN,
    EQUAL_CLASS,
    EQUAL_PROPERTY,
    INVERSE,
    KINDS,
    OWL,
    PROPERTY,
    RANGE,
    RDF,
    RDFS,
    RELATION,
    SUBCLASS,
    SUBPROPERTY,
    TYPE,
    XSD,
)

WRITTEN = {
    f"{OWL}class": CLASS,
    f"{RDFS}Class": CLASS,
    f"{OWL}objectProperty": RELATION,
    f"{OWL}datatypeProperty": PROPERTY,
}
"""The kinds that other declarations, also misspelt ones, stand for."""
WRITTEN |= {f"{OWL}{name}Property": RELATION for name in ("Transitive", "Symmetric", "Asymmetric", "Irreflexive")}
WRITTEN |= {f"{OWL}InverseFunctionalProperty": RELATION, f"{OWL}ReflexiveProperty": RELATION}
UNDECIDED = (f"{OWL}FunctionalProperty", f"{RDF}Property")
"""Instances of these classes are relations or data properties, depending on their ranges."""
OF_CLASSES = frozenset({SUBCLASS, DISJOINT, COMPLEMENT})
"""Predicates both of whose ends are classes."""


def infer_declarations(graph: Graph, triples: Sequence[ox.Triple]) -> tuple[ox.Triple, ...]:
    """Return the missing declarations of the terms in a user's ontologies.

    `graph` has all triples, `triples` are the user's among them.
    """
    found = {iri: kind for written, kind in WRITTEN.items() for iri in graph.instances(written)}
    known = {iri: kind for kind in (*KINDS, ANNOTATION, DATATYPE) for iri in graph.instances(kind)}
    undecided = {iri for cls in UNDECIDED for iri in graph.instances(cls)} - known.keys() - found.keys()
    found |= {iri: _by_range(graph, iri) for iri in sorted(undecided)}
    for iri, kind in _used(triples, {**found, **known}):
        if iri not in known and not iri.startswith(BUILT_IN):
            found.setdefault(iri, kind)
    missing = sorted((iri, kind) for iri, kind in found.items() if iri not in known and not iri.startswith(BUILT_IN))
    return tuple(ox.Triple(ox.NamedNode(iri), ox.NamedNode(TYPE), ox.NamedNode(kind)) for iri, kind in missing)


def find_undeclared(graph: Graph, assumed: Iterable[ox.Triple]) -> tuple[tuple[str, str], ...]:
    """Return the terms without any declaration, with their assumed kinds."""
    ways = (*WRITTEN, *UNDECIDED)
    declared = {iri for way in ways for iri in graph.instances(way)}
    kinds = {CLASS: "class", RELATION: "relation", PROPERTY: "property"}
    pairs = ((str(each.subject.value), str(each.object.value)) for each in assumed)  # type: ignore[union-attr]
    return tuple((iri, kinds[kind]) for iri, kind in pairs if iri not in declared)


def _by_range(graph: Graph, iri: str) -> str:
    """Return the kind of a property of which only characteristics are declared."""
    ranges = graph.objects(iri, RANGE)
    data = any(r.value.startswith((XSD, f"{RDFS}Literal")) for r in ranges if isinstance(r, ox.NamedNode))
    return PROPERTY if data or any(graph.objects(r, f"{OWL}oneOf") for r in ranges) else RELATION


def _used(triples: Sequence[ox.Triple], kinds: dict[str, str]) -> Iterator[tuple[str, str]]:
    """Yield terms with the kinds that their uses imply."""
    alike: dict[str, list[str]] = defaultdict(list)
    for each in triples:
        one, other, said = _iri(each.subject), _iri(each.object), each.predicate.value
        if said in OF_CLASSES or (said == EQUAL_CLASS and DATATYPE not in (kinds.get(one), kinds.get(other))):
            yield from ((iri, CLASS) for iri in (one, other) if iri)
        elif (said == DOMAIN and other) or (said == RANGE and other and kinds.get(one) == RELATION):
            yield other, CLASS
        elif said == INVERSE:
            yield from ((iri, RELATION) for iri in (one, other) if iri)
        elif said in (SUBPROPERTY, EQUAL_PROPERTY) and one and other:
            alike[one].append(other)
            alike[other].append(one)
    yield from _spread(alike, kinds)


def _spread(alike: dict[str, list[str]], kinds: dict[str, str]) -> Iterator[tuple[str, str]]:
    """Yield the kinds of properties that are above, below or equivalent to others of known kind."""
    todo = [iri for iri in sorted(alike) if kinds.get(iri) in (RELATION, PROPERTY)]
    reached = {iri: kinds[iri] for iri in todo}
    while todo:
        current = todo.pop()
        for other in sorted(alike[current]):
            if other not in reached and other not in kinds:
                reached[other] = reached[current]
                yield other, reached[other]
                todo.append(other)


def _iri(node: object) -> str:
    return node.value if isinstance(node, ox.NamedNode) else ""
