"""Describes ontologies: what they hold, what of it a library uses, what has no effect, how they map onto shipped ones.

They are read beside the shipped ones, with what they import.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Literal
from urllib.parse import unquote

import msgspec

from skillc.errors import RequestError
from skillc.services.library.files import LibraryFiles
from skillc.services.library.libraries import find_named_terms, load_vocabulary_with, shipped_sources
from skillc.services.library.ontology_imports import follow_imports
from skillc.services.library.source_files import read_vocabularies
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source, Span
from skillc_rdf.formats.detect import detect_format
from skillc_rdf.vocabulary.axioms.counts import AxiomCounts
from skillc_rdf.vocabulary.axioms.rules import Rules
from skillc_rdf.vocabulary.conflicts import judge_conflicts
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.imports import IMPORTS, ontology_names, plain_name
from skillc_rdf.vocabulary.iris import ANNOTATION, BUILT_IN, DATATYPE, KINDS, OWL, PROPERTY
from skillc_rdf.vocabulary.kinds import UNDECIDED, WRITTEN
from skillc_rdf.vocabulary.precedence import split_statements
from skillc_rdf.vocabulary.reading import Ontology, read_ontologies
from skillc_rdf.vocabulary.types import THING, Vocabulary

Kind = Literal["class", "relation", "property"]
_VERSION = f"{OWL}versionIRI"


class AxiomCount(msgspec.Struct, frozen=True):
    """How many axioms of a kind there are, and whether they are used."""

    kind: str
    count: int
    is_used: bool


class TermLink(msgspec.Struct, frozen=True):
    """A term of an ontology, and the shipped term that it is, or is below."""

    term: str
    kind: Kind
    link: Literal["is", "below"]
    shipped: str


class UsedTerm(msgspec.Struct, frozen=True):
    """A term of an ontology that a library names, and where it does so first."""

    term: str
    path: str
    line: int


class OntologyDescription(msgspec.Struct, frozen=True, kw_only=True):
    """What an ontology holds, and what becomes of it. Terms are as short as the prefixes allow.

    `imports` are the files of the imported ontologies by IRI, "" for one that is shipped, None for one that is missing.
    `unlinked` are the terms that are below no shipped one, with their kinds; `remarks` say what is ignored and why.
    """

    file: str
    format: str
    iris: tuple[str, ...]
    triples: int
    imports: dict[str, str | None]
    classes: int
    relations: int
    properties: int
    annotations: int
    datatypes: int
    individuals: int
    axioms: tuple[AxiomCount, ...]
    library: str | None
    used: tuple[UsedTerm, ...]
    links: tuple[TermLink, ...]
    unlinked: dict[str, Kind]
    remarks: tuple[str, ...]


class OpenOntologies(msgspec.Struct, frozen=True):
    """Ontologies as they are read beside the shipped ones: the named files, and all with what they import, by path."""

    named: tuple[str, ...]
    sources: Mapping[str, Source]
    vocabulary: Vocabulary
    problems: tuple[Diagnostic, ...]


def open_ontologies(files: Sequence[Path]) -> OpenOntologies:
    """Read files with what they import; RequestError for one that cannot be read or is no RDF."""
    named = {str(file): file for file in files}
    sources = {each.path: each for each in read_vocabularies(follow_imports(named, {}).items())}
    outcome = load_vocabulary_with(tuple(sources[path] for path in sorted(sources)))
    for each in outcome.diagnostics:
        if (
            each.severity == "error"
            and each.span.path in named
            and each.name in ("broken-turtle", "unreadable-vocabulary")
        ):
            raise RequestError(f"{each.span.path}:{each.span.line}: {each.message}")
    return OpenOntologies(tuple(named), sources, outcome.value, outcome.diagnostics)


def describe_ontologies(opened: OpenOntologies, library: LibraryFiles | None) -> list[OntologyDescription]:
    """Return what each of the named files holds, and what of it a library uses."""
    shipped = read_ontologies(shipped_sources()).value
    standing = Graph(triple for each in shipped for triple in each.triples)
    named = find_named_terms(library) if library else {}
    judged = tuple(judge_conflicts(opened.problems, opened.vocabulary, named))
    opened = msgspec.structs.replace(opened, problems=judged)
    found = read_ontologies(opened.sources[path] for path in opened.named).value
    return [_describe(each, opened, shipped, standing, library, named) for each in found]


def _describe(
    ontology: Ontology,
    opened: OpenOntologies,
    shipped: Sequence[Ontology],
    standing: Graph,
    library: LibraryFiles | None,
    named: Mapping[str, Span],
) -> OntologyDescription:
    graph = Graph(ontology.triples)
    known = frozenset(iri for kind in KINDS for iri in standing.instances(kind))
    part = split_statements(ontology, shipped, known)
    counts = AxiomCounts(part, graph, Rules(part.counting, graph))
    short = opened.vocabulary.short
    terms = _terms(graph, opened.vocabulary)
    links = tuple(_links(terms, opened.vocabulary, known))
    linked = {each.term for each in links}
    used = sorted((short(iri), span) for iri, span in named.items() if iri in terms)
    return OntologyDescription(
        file=ontology.source.path,
        format=getattr(detect_format(ontology.source), "name", "Turtle"),
        iris=(*graph.instances(f"{OWL}Ontology"), *_versions(graph)),
        triples=len(ontology.triples),
        imports=dict(_imports(graph, opened, standing)),
        classes=sum(kind == "class" for kind in terms.values()),
        relations=sum(kind == "relation" for kind in terms.values()),
        properties=sum(kind == "property" for kind in terms.values()),
        annotations=len(graph.instances(ANNOTATION)),
        datatypes=len(graph.instances(DATATYPE)),
        individuals=len(find_individuals(graph)),
        axioms=(*_counts(counts.used, True), *_counts(counts.unused, False)),
        library=library.name if library else None,
        used=tuple(UsedTerm(term, span.path, span.line) for term, span in used),
        links=links,
        unlinked={short(iri): kind for iri, kind in sorted(terms.items()) if short(iri) not in linked},
        remarks=tuple(_remarks(ontology.source.path, opened.problems)),
    )


def _terms(graph: Graph, vocabulary: Vocabulary) -> dict[str, Kind]:
    """Return the terms that a file declares with their kinds, as they are understood."""
    declared = {iri for kind in (*KINDS, *WRITTEN, *UNDECIDED) for iri in graph.instances(kind)}
    found: dict[str, Kind] = {}
    for iri in sorted(each for each in declared if not each.startswith(BUILT_IN)):
        term = vocabulary.aliases.get(iri, iri)
        if term in vocabulary.classes:
            found[iri] = "class"
        elif term in vocabulary.relations:
            found[iri] = "relation"
        elif term in vocabulary.properties or iri in graph.instances(PROPERTY):
            found[iri] = "property"
    return found


def find_individuals(graph: Graph) -> frozenset[str]:
    """Return the IRIs of what a graph says to be of a class that is no part of OWL itself."""
    own = (kind for kind in graph.kinds() if not kind.startswith(BUILT_IN) or kind == f"{OWL}NamedIndividual")
    return frozenset(iri for kind in own for iri in graph.instances(kind))


def _versions(graph: Graph) -> tuple[str, ...]:
    return tuple(iri for each in graph.instances(f"{OWL}Ontology") for iri in graph.iris(each, _VERSION))


def _imports(graph: Graph, opened: OpenOntologies, standing: Graph) -> Iterator[tuple[str, str | None]]:
    """Yield what a graph imports, with the file."""
    files = {
        name: path
        for path, source in opened.sources.items()
        for each in read_ontologies([source]).value
        for name in ontology_names(Graph(each.triples))
    }
    files |= dict.fromkeys(ontology_names(standing), "")
    for each in graph.instances(f"{OWL}Ontology"):
        for iri in graph.iris(each, IMPORTS):
            at = unquote(iri.removeprefix("file:///"))
            yield iri, files.get(plain_name(iri), at if at in opened.sources else None)


def _counts(counts: Counter[str], is_used: bool) -> Iterator[AxiomCount]:
    for kind, count in sorted(counts.items(), key=lambda each: (-each[1], each[0])):
        yield AxiomCount(kind, count, is_used)


def _links(terms: Mapping[str, Kind], vocabulary: Vocabulary, shipped: frozenset[str]) -> Iterator[TermLink]:
    """Yield how terms are linked with the nearest shipped ones."""
    for iri, kind in terms.items():
        same = vocabulary.aliases.get(iri, iri)
        if same in shipped:
            yield TermLink(vocabulary.short(iri), kind, "is", vocabulary.short(same))
            continue
        above = find_above(vocabulary, same) & shipped
        nearest = above - {other for each in above for other in find_above(vocabulary, each) - {each}}
        for each in sorted(nearest):
            yield TermLink(vocabulary.short(iri), kind, "below", vocabulary.short(each))


def find_above(vocabulary: Vocabulary, iri: str) -> frozenset[str]:
    """Return the classes, or the relations, above a term, itself included; owl:Thing is not among them."""
    return (vocabulary.ancestors.get(iri) or vocabulary.super_relations.get(iri, frozenset())) - {THING}


def _remarks(path: str, problems: Sequence[Diagnostic]) -> Iterator[str]:
    """Yield what is said of a file, but for its imports and axioms, which are listed."""
    for each in problems:
        if each.span.path == path and each.name not in ("missing-import", "unused-axiom"):
            line = f"line {each.span.line}: " if each.span.line > 1 else ""
            yield f"{line}{each.message}"
