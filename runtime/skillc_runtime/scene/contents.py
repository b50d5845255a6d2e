"""What Turtle files speak of, and by which labels: a world state keeps neither."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import pyoxigraph as ox

from skillc_rdf.turtle.terms import RDFS
from skillc_runtime.scene.documents import Document, statements_of
from skillc_runtime.scene.statements import iri_of

LABEL = f"{RDFS}label"


@dataclass(frozen=True, slots=True)
class Contents:
    """The IRIs that files make statements about, and the first rdfs:label of those that have one."""

    subjects: frozenset[str]
    labels: dict[str, str]


def read_contents(documents: Iterable[Document]) -> Contents:
    """Return what the documents speak of; SceneError for one that is not Turtle."""
    said = [each for document in documents for each in statements_of(document)]
    labels: dict[str, str] = {}
    for each in said:
        if each.predicate == LABEL and isinstance(each.object, ox.Literal):
            labels.setdefault(iri_of(each.subject), each.object.value)
    return Contents(frozenset(iri_of(each.subject) for each in said) - {""}, labels)
