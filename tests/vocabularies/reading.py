"""Reads ontologies of the tests beside the shipped ones."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from skillc_dsl.diagnostics import Outcome
from skillc_dsl.source import Source
from skillc_ontology.catalogue import vocabulary_files
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import Vocabulary

STOCK = Path(__file__).parent / "stock"
T = "http://example.org/t#"
HEAD = f"""@prefix t: <{T}> . @prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> . @prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix sumo: <http://www.inf.ufrgs.br/phi-group/ontologies/sumo.owl#> .
"""


@cache
def shipped() -> tuple[Source, ...]:
    """Return the shipped vocabularies."""
    return tuple(Source(path, text) for path, text in vocabulary_files())


@cache
def shipped_alone() -> Vocabulary:
    """Return the shipped vocabularies as they are read without others."""
    return load(shipped()).value


def beside(*sources: Source) -> Outcome[Vocabulary]:
    """Read ontologies beside the shipped ones."""
    return load(shipped(), sources)


def told(text: str) -> list[tuple[str, str, int]]:
    """Return severity, name and line of what is told of a Turtle text; its first line is the first behind HEAD."""
    return [
        (d.severity, d.name, d.span.line - HEAD.count("\n")) for d in beside(Source("t.ttl", HEAD + text)).diagnostics
    ]
