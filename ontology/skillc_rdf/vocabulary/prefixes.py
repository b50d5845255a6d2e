"""Chooses the prefix of each ontology: its preferred one, the one its file declares, or the file's name."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import PurePath

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.formats.detect import detect_format
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.iris import BUILT_IN, KINDS, OWL, TYPE, VANN
from skillc_rdf.vocabulary.reading import Ontology

_NAME = re.compile(r"[A-Za-z]\w*")
_DECLARED = re.compile(
    r"@?prefix\b(?::\s*|\s*\(\s*|\s+)(?P<name>[\w.-]+)\s*:\s*=?\s*<(?P<iri>[^>\s]+)>"
    r"|(?:xmlns:|<prefix\s+name=[\"'])(?P<xml_name>[\w.-]+)(?:[\"']\s+IRI)?\s*=\s*[\"'](?P<xml_iri>[^\"'\s]+)[\"']",
    re.I,
)
"""Declarations of Turtle, of the functional and Manchester syntaxes of OWL, of XML, and of OWL/XML."""


def preferred_prefixes(graph: Graph) -> dict[str, str]:
    """Return the prefixes that ontologies prefer (`vann`), with their namespaces."""
    pairs = (
        (graph.text(iri, f"{VANN}preferredNamespacePrefix"), graph.text(iri, f"{VANN}preferredNamespaceUri"))
        for iri in graph.instances(f"{OWL}Ontology")
    )
    return {prefix: base for prefix, base in sorted((p or "", b or "") for p, b in pairs) if prefix and base}


def choose_prefixes(graph: Graph, own: Sequence[Ontology], known: Mapping[str, str]) -> dict[str, str]:
    """Return all prefixes; `known` are those of the shipped ontologies, which are reserved."""
    found = {**preferred_prefixes(graph), **known}
    for ontology in own:
        base = find_namespace(ontology)
        if base is not None and base not in found.values():
            name = next(name for name in _candidates(ontology, base) if found.get(name, base) == base)
            found[name] = base
    return dict(sorted(found.items()))


def report_taken_prefixes(own: Iterable[Ontology], known: Mapping[str, str]) -> Iterator[Diagnostic]:
    """Report ontologies that prefer the prefix of a shipped one."""
    for ontology in own:
        for prefix, base in preferred_prefixes(Graph(ontology.triples)).items():
            if known.get(prefix, base) != base:
                yield Diagnostic(
                    "prefix-taken",
                    Span(ontology.source.path, 1, 1, 1, 2),
                    f"the prefix `{prefix}` of this ontology belongs to <{known[prefix]}>",
                    help="give it another vann:preferredNamespacePrefix",
                    severity="warning",
                )


def find_namespace(ontology: Ontology) -> str | None:
    """Return the namespace in which a file declares most of its terms; None if it declares no terms."""
    kinds = {ox.NamedNode(kind) for kind in (*KINDS, f"{OWL}class")}
    terms = {
        each.subject.value
        for each in ontology.triples
        if each.predicate.value == TYPE and each.object in kinds and isinstance(each.subject, ox.NamedNode)
    }
    counts = Counter(_base(iri) for iri in sorted(terms) if not iri.startswith(BUILT_IN))
    return counts.most_common(1)[0][0] if counts else None


def _candidates(ontology: Ontology, base: str) -> Iterator[str]:
    """Yield names for a namespace, the best first, in an infinite sequence."""
    source = ontology.source
    for each in ontology.triples:
        if each.predicate.value == f"{VANN}preferredNamespacePrefix" and isinstance(each.object, ox.Literal):
            yield from (each.object.value,) if _NAME.fullmatch(each.object.value) else ()
    if detect_format(source) != ox.RdfFormat.JSON_LD:
        for match in _DECLARED.finditer(source.text):
            name, iri = match["name"] or match["xml_name"], match["iri"] or match["xml_iri"]
            if iri == base and _NAME.fullmatch(name):
                yield name
    stem = re.sub(r"\W", "_", PurePath(source.path).stem)
    stem = stem if _NAME.fullmatch(stem) else f"v{stem}"
    yield stem
    number = 2
    while True:
        yield f"{stem}{number}"
        number += 1


def _base(iri: str) -> str:
    return iri[: max(iri.rfind("#"), iri.rfind("/")) + 1]
