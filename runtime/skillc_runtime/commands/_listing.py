"""What a scene says and the answers of queries, as text and as JSON."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping

from skillc_runtime.scene.contents import read_contents
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import sheet_documents, world_of
from skillc_runtime.scene.query import Cell, run_query
from skillc_runtime.store.triples import all_facts
from skillc_runtime.world.state.listing import Entry, list_entries
from skillc_runtime.world.state.values import plain, show
from skillc_runtime.world.state.world_state import WorldState


def labels_of(scene: Document) -> dict[str, str]:
    """Return the labels of a scene's individuals and of those that ship with skillc."""
    return {**read_contents(sheet_documents()).labels, **read_contents([scene]).labels}


def listed(state: WorldState, labels: Mapping[str, str], individuals: Iterable[str], as_json: bool) -> str:
    """Return what is written of individuals: as text a paragraph for each, as JSON a list of objects."""
    entries = list_entries(state, individuals)
    if as_json:
        return json.dumps([as_object(entry, labels.get(entry.individual), state) for entry in entries], indent=2)
    return "\n\n".join(paragraph(entry, labels.get(entry.individual), state) for entry in entries)


def kept(place: str, state: WorldState) -> Document:
    """Return as a document what a world that a store keeps says beside the shipped ontology."""
    shipped = frozenset(all_facts(world_of(sheet_documents(), state.vocabulary)))
    return Document(place, "".join(sorted(f"{fact} .\n" for fact in all_facts(state) if fact not in shipped)))


def answer(scene: Document, sparql: str, state: WorldState, as_json: bool) -> str:
    """Answer a query over the scene and the shipped ontology, as a table or as a list of objects."""
    result = run_query([scene, *sheet_documents()], sparql, state.vocabulary)
    if as_json:
        return json.dumps([dict(zip(result.columns, row, strict=True)) for row in result.rows], indent=2)
    rows = [result.columns, *(tuple(map(_text, row)) for row in result.rows)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(result.columns))]
    return "\n".join("  ".join(text.ljust(w) for text, w in zip(row, widths, strict=True)).rstrip() for row in rows)


def _text(cell: Cell) -> str:
    if isinstance(cell, bool):
        return show(cell)
    return "" if cell is None else str(cell)


def paragraph(entry: Entry, label: str | None, state: WorldState) -> str:
    """Return what is written of an individual, one statement to a line."""
    short = state.vocabulary.short
    called = "" if label is None else f'  "{label}"'
    lines = [f"{short(entry.individual)}{called}  a {', '.join(map(short, entry.types))}"]
    lines += [f"    {short(relation)} {short(other)}" for relation, other in entry.relations]
    lines += [f"    {short(name)} {show(value)}" for name, value in entry.properties]
    return "\n".join(lines)


def as_object(entry: Entry, label: str | None, state: WorldState) -> dict[str, object]:
    """Return what is written of an individual, for JSON."""
    short = state.vocabulary.short
    related: dict[str, list[str]] = {}
    for relation, other in entry.relations:
        related.setdefault(short(relation), []).append(short(other))
    return {
        "individual": short(entry.individual),
        "label": label,
        "types": [short(each) for each in entry.types],
        "relations": related,
        "properties": {short(name): plain(value) for name, value in entry.properties},
    }
