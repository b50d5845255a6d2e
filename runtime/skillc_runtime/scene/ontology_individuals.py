"""Individuals that no scene declares: those of enumerations, and those of ontologies that a scene mentions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from skillc_dsl.diagnostics import Diagnostic
from skillc_rdf.turtle.statements import Parsed
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.documents import Document, parse
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.state.world_state import WorldState

PATH = "ontologies"
"""What stands for the path of a file where it is said of what classes such individuals are."""


def enumerated(vocabulary: Vocabulary) -> list[Document]:
    """Return a document with all individuals of enumerations, which are part of every world, if there are any."""
    lines = (f"<{iri}> a <{cls}> .\n" for cls, values in vocabulary.enumerations.items() for iri in values)
    text = "".join(lines)
    return [Document(PATH, text)] if text else []


def check_enumerations(state: WorldState) -> Iterator[SceneViolation]:
    """Yield each individual of an enumeration that is none of its values."""
    short = state.vocabulary.short
    for cls, values in state.vocabulary.enumerations.items():
        for individual in sorted(state.instances(cls) - set(values)):
            message = f"{short(individual)} is no value of {short(cls)}"
            yield SceneViolation(
                individual, RDF_TYPE, "wrong-data-type", message, f"it is {' or '.join(map(short, values))}"
            )


def described_elsewhere(parsed: Sequence[Parsed], vocabulary: Vocabulary) -> list[Parsed]:
    """Return what ontologies say of the individuals that documents mention and do not describe, if of any."""
    if not vocabulary.individuals:
        return []
    described, mentioned = set[str](), set[str]()
    for document in parsed:
        for each in document.statements:
            if each.predicate == RDF_TYPE:
                described.add(iri_of(each.subject))
            else:
                mentioned.add(iri_of(each.object))
    wanted = sorted(vocabulary.individuals.keys() & mentioned - described)
    lines = [f"<{iri}> a {', '.join(f'<{cls}>' for cls in vocabulary.individuals[iri])} .\n" for iri in wanted]
    return [parse(Document(PATH, "".join(lines)))] if lines else []


def without_elsewhere(problems: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield the problems of scenes; those of ontologies are reported where these are read."""
    for each in problems:
        if any(label.span.path == PATH for label in each.labels):
            yield replace(each, labels=tuple(label for label in each.labels if label.span.path != PATH))
        elif each.span.path != PATH:
            yield each
