"""Proposes which terms of other ontologies are below shipped ones, by their names and labels; a person decides."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import msgspec
import pyoxigraph as ox

from skillc.services.library.libraries import load_vocabulary_with, shipped_sources
from skillc.services.library.ontologies import Kind, OntologyDescription, OpenOntologies
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.conflicts import Conflict
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.iris import KINDS, OWL, RDFS, SUBCLASS, SUBPROPERTY
from skillc_rdf.vocabulary.reading import read_ontologies
from skillc_rdf.vocabulary.types import local_name

_LABELS = (f"{RDFS}label", *(f"http://www.w3.org/2004/02/skos/core#{name}" for name in ("prefLabel", "altLabel")))
_PARTS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_PREDICATES: Mapping[Kind, str] = {"class": SUBCLASS, "relation": SUBPROPERTY, "property": SUBPROPERTY}
_FILE = "the proposals"


class Proposal(msgspec.Struct, frozen=True):
    """A term that may be below a shipped one; `why_not` is "" unless something speaks against it. IRIs are whole."""

    term: str
    kind: Kind
    shipped: str
    ground: str
    why_not: str = ""


class _Name(NamedTuple):
    """A name of a term as it is compared, and what it is."""

    words: str
    ground: str


def propose_alignment(opened: OpenOntologies, described: Sequence[OntologyDescription]) -> list[Proposal]:
    """Return proposals for the terms of described ontologies that are below no shipped one, by their IRIs.

    One is made if a name or label of both is the same, in any writing. One that would make something impossible, and
    those of a term that could be several, say so.
    """
    shipped = _by_name(Graph(t for each in read_ontologies(shipped_sources()).value for t in each.triples), opened)
    named = read_ontologies(opened.sources[path] for path in opened.named).value
    graph = Graph(triple for each in named for triple in each.triples)
    unlinked = {name: kind for each in described for name, kind in each.unlinked.items()}
    terms = {opened.vocabulary.short(iri): iri for iri in opened.vocabulary.terms}
    found: list[Proposal] = []
    for name, kind in sorted(unlinked.items()):
        iri = terms.get(name)
        fitting = dict(_fitting(graph, iri, shipped[kind])) if iri else {}
        other = "it could be several" if len(fitting) > 1 else ""
        found += [Proposal(iri or "", kind, ours, ground, other) for ours, ground in sorted(fitting.items())]
    return _without_conflicts(found, opened)


def format_proposals(proposals: Sequence[Proposal], prefixes: Mapping[str, str]) -> str:
    """Return proposals as an ontology in Turtle; those that something speaks against are comments."""
    used = sorted(
        (prefix, base)
        for prefix, base in prefixes.items()
        if prefix and any(iri.startswith(base) for each in proposals for iri in (each.term, each.shipped))
    )
    known = {"owl": OWL, "rdfs": RDFS, **dict(used)}
    lines = [f"@prefix {prefix}: <{base}> ." for prefix, base in sorted(known.items())]
    lines += ["", "<http://example.org/alignment> a owl:Ontology .", ""]
    for each in proposals:
        said = f"{_short(each.term, known)} {_short(_PREDICATES[each.kind], known)} {_short(each.shipped, known)} ."
        ground = f"{each.ground}; {each.why_not}" if each.why_not else each.ground
        lines.append(f"{'# ' if each.why_not else ''}{said}  # {ground}")
    return "\n".join(lines) + "\n"


def _by_name(graph: Graph, opened: OpenOntologies) -> Mapping[Kind, Mapping[str, dict[str, str]]]:
    """Return the shipped terms by kind and name, with the ground of each."""
    of_kind: dict[Kind, Mapping[str, object]] = {
        "class": opened.vocabulary.classes,
        "relation": opened.vocabulary.relations,
        "property": opened.vocabulary.properties,
    }
    standing = {iri for kind in KINDS for iri in graph.instances(kind)}
    found: dict[Kind, dict[str, dict[str, str]]] = {}
    for kind, terms in of_kind.items():
        names: dict[str, dict[str, str]] = defaultdict(dict)
        for iri in sorted(standing.intersection(terms)):
            for name in _names(graph, iri):
                names[name.words].setdefault(iri, name.ground)
        found[kind] = names
    return found


def _fitting(graph: Graph, iri: str, shipped: Mapping[str, dict[str, str]]) -> Iterator[tuple[str, str]]:
    """Yield the shipped terms that have a name of a term, with the ground."""
    for name in reversed(list(_names(graph, iri))):
        for ours, ground in shipped.get(name.words, {}).items():
            yield ours, f"{name.ground} is {ground}" if name.ground != ground else f"both have the {name.ground}"


def _names(graph: Graph, iri: str) -> Iterator[_Name]:
    """Yield the names of a term, its own first."""
    local = local_name(iri)
    yield _Name(_normalise(local), f"name {local}")
    for predicate in _LABELS:
        for label in graph.objects(iri, predicate):
            if isinstance(label, ox.Literal) and (words := _normalise(label.value)):
                yield _Name(words, f'label "{label.value}"')


def _normalise(name: str) -> str:
    """Return the words of a name in small letters: `physical object` for `PhysicalObject` and `physical_object`."""
    return " ".join(part.lower() for part in _PARTS.findall(name))


def _without_conflicts(proposals: Sequence[Proposal], opened: OpenOntologies) -> list[Proposal]:
    """Return proposals; those under which something would become impossible say what."""
    texts = tuple(opened.sources[path] for path in sorted(opened.sources))
    before = _conflicts(texts)
    found = list(proposals)
    while True:
        sure = [each for each in found if not each.why_not]
        said = _conflicts((*texts, Source(_FILE, format_proposals(sure, {}))))
        wrong = {term: text for text, concerned in said.items() if text not in before for term in concerned}
        doubtful = [each for each in sure if each.term in wrong]
        if not doubtful:
            return found
        found = [
            msgspec.structs.replace(each, why_not=f"it would not hold: {wrong[each.term]}")
            if each in doubtful
            else each
            for each in found
        ]


def _conflicts(texts: tuple[Source, ...]) -> dict[str, frozenset[str]]:
    """Return what is impossible in ontologies, with the terms that it concerns."""
    found = load_vocabulary_with(texts).diagnostics
    return {each.message: each.concerns | {each.term} for each in found if isinstance(each, Conflict)}


def _short(iri: str, prefixes: Mapping[str, str]) -> str:
    fitting = [(len(base), prefix) for prefix, base in prefixes.items() if iri.startswith(base)]
    local = iri[max(fitting)[0] :] if fitting else ""
    return f"{max(fitting)[1]}:{local}" if fitting and re.fullmatch(r"\w[\w-]*", local) else f"<{iri}>"
