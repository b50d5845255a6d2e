"""The facts of a store on disk: a pyoxigraph folder, which any tool built on Oxigraph can query."""

from __future__ import annotations

import shutil
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import pyoxigraph as ox

from skillc_runtime.store.store import StoredWorld
from skillc_runtime.world.state.transactions import StoreError

STORE = ox.NamedNode("https://w3id.org/skillc/store#this")
SEQUENCE = ox.NamedNode("https://w3id.org/skillc/store#sequence")
BEGINNING = ox.NamedNode("https://w3id.org/skillc/store#beginning")
LOG = ox.NamedNode("https://w3id.org/skillc/store#log")
"""The graph with the metadata of a store; facts are in the default graph."""


def create(folder: Path, triples: Iterable[ox.Triple], sequence: int, beginning: str) -> None:
    """Write a new folder, completely or not at all; StoreError when it cannot be written."""
    half = folder.with_name(f"{folder.name}.half")
    try:
        shutil.rmtree(half, ignore_errors=True)
        store = ox.Store(str(half))
        store.bulk_extend(ox.Quad(each.subject, each.predicate, each.object) for each in triples)
        store.extend(_metadata(sequence, beginning))
        store.flush()
        del store
        half.rename(folder)
    except (OSError, RuntimeError) as error:
        raise StoreError(f"the facts cannot be written to {folder}: {error}") from error


def read(folder: Path) -> StoredWorld:
    """Return the contents of a folder, empty if it does not exist; StoreError when it is damaged."""
    if not folder.exists():
        return StoredWorld(0, "", ())
    try:
        store = ox.Store.read_only(str(folder))
        sequence, beginning = _read_text(store, SEQUENCE), _read_text(store, BEGINNING)
        quads = store.quads_for_pattern(None, None, None, ox.DefaultGraph())
        return StoredWorld(int(sequence), beginning, tuple(quad.triple for quad in quads))
    except (OSError, RuntimeError, ValueError) as error:
        raise _damaged(folder, error) from error


class FactsHead(NamedTuple):
    """What identifies a folder with facts among all that were ever made, its last transaction, and its beginning."""

    identity: str
    sequence: int
    beginning: str


def read_head(folder: Path) -> FactsHead:
    """Return what identifies the contents of a folder; StoreError when it is damaged."""
    try:
        identity = (folder / "IDENTITY").read_text("utf-8").strip()
        store = ox.Store.read_only(str(folder))
        return FactsHead(identity, int(_read_text(store, SEQUENCE)), _read_text(store, BEGINNING))
    except (OSError, RuntimeError, ValueError) as error:
        raise _damaged(folder, error) from error


def sequence(folder: Path) -> int:
    """Return the number of the last transaction in a folder; StoreError when it is damaged."""
    try:
        return int(_read_text(ox.Store.read_only(str(folder)), SEQUENCE))
    except (OSError, RuntimeError, ValueError) as error:
        raise _damaged(folder, error) from error


def advance(folder: Path, removed: Iterable[ox.Triple], added: Iterable[ox.Triple], before: int, after: int) -> None:
    """Update a folder from one transaction to a later one, atomically; StoreError when it cannot be written."""
    old, new = f"{STORE} {SEQUENCE} {before}", f"{STORE} {SEQUENCE} {after}"
    update = (
        f"DELETE DATA {{ {_text(removed)} GRAPH {LOG} {{ {old} }} }};\n"
        f"INSERT DATA {{ {_text(added)} GRAPH {LOG} {{ {new} }} }}"
    )
    try:
        store = ox.Store(str(folder))
        store.update(update)
        store.flush()
    except (OSError, RuntimeError) as error:
        raise StoreError(f"the facts cannot be written to {folder}: {_first_line(error)}") from error


def _metadata(sequence: int, beginning: str) -> list[ox.Quad]:
    return [
        ox.Quad(STORE, SEQUENCE, ox.Literal(sequence), LOG),
        ox.Quad(STORE, BEGINNING, ox.Literal(beginning), LOG),
    ]


def _read_text(store: ox.Store, property_: ox.NamedNode) -> str:
    for quad in store.quads_for_pattern(STORE, property_, None, LOG):
        if isinstance(quad.object, ox.Literal):
            return quad.object.value
    raise ValueError(f"{property_} is missing")


def _damaged(folder: Path, error: Exception) -> StoreError:
    return StoreError(
        f"the facts in {folder} are damaged ({_first_line(error)}); restore the folder from a copy, "
        "or fill the store again with --reset"
    )


def _text(triples: Iterable[ox.Triple]) -> str:
    return "".join(f"{triple} .\n" for triple in triples)


def _first_line(error: Exception) -> str:
    return str(error).partition("\n")[0] or type(error).__name__
