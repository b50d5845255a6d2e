"""SPARQL over a scene, the packaged vocabularies and data sheets."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import pyoxigraph as ox

from skillc_compiler.library.vocabulary import Vocabulary
from skillc_runtime.world.documents import Document, parse


class QueryError(ValueError):
    """A query that is not SPARQL; the message says where it stops making sense."""


@dataclass(frozen=True, slots=True)
class Answer:
    """The answer of a query: names of the columns and rows of text, individuals shortened by the prefixes."""

    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def query(documents: Iterable[Document], sparql: str, vocabulary: Vocabulary) -> Answer:
    """Return the answer of a query over documents; the vocabulary's prefixes need no declaration.

    QueryError for a text that is not SPARQL, SceneError for a document that is not Turtle.
    """
    store = ox.Store()
    for document in documents:
        store.extend(
            ox.Quad(each.subject, ox.NamedNode(each.predicate), each.object)
            for each in parse(document).statements
            if not isinstance(each.subject, ox.Literal)
        )
    try:
        result = store.query(sparql, prefixes=dict(vocabulary.prefixes))
    except SyntaxError as error:
        raise QueryError(f"this is not SPARQL: {error}") from error
    if isinstance(result, ox.QueryBoolean):
        return Answer(("answer",), (("yes" if bool(result) else "no",),))
    if isinstance(result, ox.QueryTriples):
        rows = [tuple(_text(node, vocabulary) for node in triple) for triple in result]
        return Answer(("subject", "predicate", "object"), tuple(rows))
    columns = tuple(variable.value for variable in result.variables)
    return Answer(columns, tuple(tuple(_text(row[name], vocabulary) for name in columns) for row in result))


def _text(node: object, vocabulary: Vocabulary) -> str:
    if isinstance(node, ox.NamedNode):
        return vocabulary.short(node.value)
    return node.value if isinstance(node, ox.Literal) else "" if node is None else str(node)
