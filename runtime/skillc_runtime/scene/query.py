"""Runs SPARQL queries over a scene, the packaged vocabularies and data sheets."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias

import msgspec
import pyoxigraph as ox

from skillc_rdf.turtle.terms import OWL, RDF, RDFS, XSD
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.documents import Document, statements_of
from skillc_runtime.scene.query_errors import federation_error, nesting_error, syntax_error_message
from skillc_runtime.store.literals import INTEGERS, NUMBERS

QueryValue: TypeAlias = bool | int | float | str | None
"""A value in a result; individuals are texts, None is an unbound variable."""

WELL_KNOWN = {"rdf": RDF, "rdfs": RDFS, "owl": OWL, "xsd": XSD}


class QueryError(ValueError):
    """A query that cannot be answered; the message gives the reason and the position."""


@dataclass(frozen=True, slots=True)
class QueryAnswer:
    """The result of a query: column names and rows of values; individuals are shortened by prefixes."""

    columns: tuple[str, ...]
    rows: tuple[tuple[QueryValue, ...], ...]


def run_query(
    documents: Iterable[Document],
    sparql: str,
    vocabulary: Vocabulary,
    more: Iterable[ox.Quad] = (),
) -> QueryAnswer:
    """Return the result of a query over documents; the vocabulary's prefixes need no declaration.

    `more` are further statements, in the default graph or in named ones.
    QueryError for a syntax error, an update, too many nested brackets, a query to another server or a failed
    evaluation; SceneError for a document that is not Turtle.
    """
    vocabulary = msgspec.structs.replace(vocabulary, prefixes={**WELL_KNOWN, **vocabulary.prefixes})
    refusal = federation_error(sparql) or nesting_error(sparql)
    if refusal is not None:
        raise QueryError(refusal)
    store = _store(documents)
    store.extend(more)
    try:
        return _answer(store.query(sparql, prefixes=dict(vocabulary.prefixes)), vocabulary)
    except SyntaxError as error:
        raise QueryError(syntax_error_message(sparql, str(error), vocabulary.prefixes)) from error
    except (OSError, RuntimeError, ValueError) as error:
        raise QueryError(f"the query cannot be answered: {error}") from error


def _store(documents: Iterable[Document]) -> ox.Store:
    store = ox.Store()
    for document in documents:
        store.extend(
            ox.Quad(each.subject, ox.NamedNode(each.predicate), each.object)
            for each in statements_of(document)
            if not isinstance(each.subject, ox.Literal)
        )
    return store


def _answer(result: ox.QuerySolutions | ox.QueryBoolean | ox.QueryTriples, vocabulary: Vocabulary) -> QueryAnswer:
    """Return the complete result; solutions are computed while they are read."""
    if isinstance(result, ox.QueryBoolean):
        return QueryAnswer(("answer",), ((bool(result),),))
    if isinstance(result, ox.QueryTriples):
        triples = [tuple(_cell(node, vocabulary) for node in triple) for triple in result]
        return QueryAnswer(("subject", "predicate", "object"), tuple(triples))
    columns = tuple(variable.value for variable in result.variables)
    return QueryAnswer(columns, tuple(tuple(_cell(row[name], vocabulary) for name in columns) for row in result))


def _cell(node: object, vocabulary: Vocabulary) -> QueryValue:
    if node is None:
        return None
    if isinstance(node, ox.NamedNode):
        return vocabulary.short(node.value)
    return _value(node) if isinstance(node, ox.Literal) else str(node)


def _value(literal: ox.Literal) -> QueryValue:
    """Return the value of a literal; NaN, infinity and invalid literals stay text."""
    kind, text = literal.datatype.value, literal.value
    if kind == XSD + "boolean" and text in ("true", "false", "1", "0"):
        return text in ("true", "1")
    if kind not in NUMBERS:
        return text
    try:
        number = int(text) if kind in INTEGERS else float(text)
        return number if math.isfinite(number) else text
    except (ValueError, OverflowError):
        return text
