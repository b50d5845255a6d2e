"""A world state and the answers of queries as text and as JSON."""

from __future__ import annotations

import json
from pathlib import Path

from skillc_ontology.catalogue import vocabulary_files
from skillc_runtime.world.documents import Document
from skillc_runtime.world.listing import Entry, listing
from skillc_runtime.world.query import query
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.values import show


def as_text(state: WorldState) -> str:
    """Return a paragraph for each individual."""
    return "\n\n".join(_paragraph(entry, state) for entry in listing(state))


def as_json(state: WorldState) -> str:
    """Return a list of objects, one for each individual."""
    return json.dumps([_object(entry, state) for entry in listing(state)], indent=2)


def answer(scene: Path, sparql: str, state: WorldState, as_json: bool) -> str:
    """Answer a query over the scene and the shipped ontology, as a table or as a list of objects."""
    documents = [Document.read(scene), *(Document(name, text) for name, text in vocabulary_files())]
    result = query(documents, sparql, state.vocabulary)
    if as_json:
        return json.dumps([dict(zip(result.columns, row, strict=True)) for row in result.rows], indent=2)
    rows = [result.columns, *result.rows]
    widths = [max(len(row[i]) for row in rows) for i in range(len(result.columns))]
    return "\n".join("  ".join(text.ljust(w) for text, w in zip(row, widths, strict=True)).rstrip() for row in rows)


def _paragraph(entry: Entry, state: WorldState) -> str:
    short = state.vocabulary.short
    lines = [f"{short(entry.individual)}  a {', '.join(map(short, entry.types))}"]
    lines += [f"    {short(relation)} {short(other)}" for relation, other in entry.relations]
    lines += [f"    {short(name)} {show(value)}" for name, value in entry.properties]
    return "\n".join(lines)


def _object(entry: Entry, state: WorldState) -> dict[str, object]:
    short = state.vocabulary.short
    related: dict[str, list[str]] = {}
    for relation, other in entry.relations:
        related.setdefault(short(relation), []).append(short(other))
    return {
        "individual": short(entry.individual),
        "types": [short(each) for each in entry.types],
        "relations": related,
        "properties": {short(name): value for name, value in entry.properties},
    }
