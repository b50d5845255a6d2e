"""Keeps the world of a large store in a file beside its facts, from which it is opened in a fraction of the time.

The file counts only for the facts and the vocabulary from which it was made, and only if it is whole; else it is as if
there were none, and the world is built from the facts.
"""

from __future__ import annotations

import mmap
import os
import zlib
from array import array
from collections.abc import Iterable, Mapping
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple, Protocol, TypeAlias, runtime_checkable

import msgspec

from skillc_rdf.vocabulary.types import ClassTerm, Vocabulary
from skillc_runtime.world.state.bulk import FactTables, build_world_state
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

MAGIC = b"skillc world index 1\n"
LEAST = 10_000
"""The least number of individuals of a world that is worth a file."""
Plain: TypeAlias = bool | int | float | str | tuple[bool | int | float | str, ...] | None
_PLAIN = (bool, int, float, str)


class IndexPlace(NamedTuple):
    """Where the index of a store is; `facts` identifies the facts that it has to be of, after how many transactions."""

    file: Path
    facts: str
    sequence: int
    beginning: str


@runtime_checkable
class Indexed(Protocol):
    """A store that has room for an index beside its facts."""

    def find_index(self) -> IndexPlace | None:
        """Return where the index of the present facts is; None if there are no facts, or later transactions."""


class _Tables(msgspec.Struct, frozen=True):
    """All facts by number of individuals and IRIs in `names`: columns of 4 bytes in the order of the machine.

    `types` are the individuals and the numbers of their classes in `classes`; `related` the subjects and objects of
    each relation; `valued` the individuals and the values of each property.
    """

    made_of: str
    prefixes: dict[str, str]
    own: list[ClassTerm]
    names: list[str]
    classes: list[list[str]]
    types: tuple[bytes, bytes]
    related: dict[str, tuple[bytes, bytes]]
    valued: dict[str, tuple[bytes, list[Plain]]]


def read_index(place: IndexPlace, library: Vocabulary) -> WorldState | None:
    """Return the world in an index; None if there is none of these facts and this vocabulary, or it is damaged."""
    try:
        with place.file.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
            start = len(MAGIC) + 4
            if content[: len(MAGIC)] != MAGIC:
                return None
            with memoryview(content) as view, view[start:] as body:
                if zlib.crc32(body) != int.from_bytes(content[len(MAGIC) : start], "big"):
                    return None
                tables = msgspec.msgpack.decode(body, type=_Tables)
    except (OSError, ValueError, msgspec.MsgspecError):
        return None
    return _world(tables, library) if tables.made_of == _made_of(place, library) else None


def write_index(place: IndexPlace, library: Vocabulary, state: WorldState) -> None:
    """Write the index of a world, completely or not at all; nothing for a small world, or if it cannot be written."""
    tables = _tables(place, library, state) if len(state.individuals) >= LEAST else None
    if tables is None:
        return
    body = msgspec.msgpack.encode(tables)
    half = place.file.with_name(f"{place.file.name}.{os.getpid()}.half")
    try:
        half.write_bytes(MAGIC + zlib.crc32(body).to_bytes(4, "big") + body)
        half.replace(place.file)
    except OSError:
        half.unlink(missing_ok=True)


def _made_of(place: IndexPlace, library: Vocabulary) -> str:
    """Return what an index is made of: the facts and the vocabulary."""
    return f"{place.facts} {place.sequence} {sha256(msgspec.msgpack.encode(library)).hexdigest()}"


def _tables(place: IndexPlace, library: Vocabulary, state: WorldState) -> _Tables | None:
    """Return the facts of a world as tables; None if a value is no number, text or truth value."""
    numbers: dict[str, int] = {}
    types = [(individual, classes) for individual, classes in state.direct.items() if classes]
    sets = {classes: number for number, classes in enumerate(dict.fromkeys(classes for _, classes in types))}
    valued: dict[str, tuple[bytes, list[Plain]]] = {}
    for iri, table in state.stored.items():
        rows = [(one, value) for one, value in table.items() if value is not None]
        if not all(_is_plain(value) for _, value in rows):
            return None
        if rows:
            valued[iri] = _column(numbers, (one for one, _ in rows)), [value for _, value in rows]  # type: ignore[misc]
    own = [term for iri, term in state.vocabulary.classes.items() if iri not in library.classes]
    related = {iri: tuple(links.pairs()) for iri, links in state.asserted.items() if links.forward}
    return _Tables(
        made_of=_made_of(place, library),
        prefixes=dict(state.vocabulary.prefixes),
        own=own,
        types=(_column(numbers, (one for one, _ in types)), array("I", [sets[of] for _, of in types]).tobytes()),
        classes=[sorted(classes) for classes in sets],
        related={
            iri: (_column(numbers, (one for one, _ in pairs)), _column(numbers, (other for _, other in pairs)))
            for iri, pairs in related.items()
        },
        valued=valued,
        names=list(numbers),
    )


def _is_plain(value: Value) -> bool:
    if isinstance(value, tuple):
        return all(isinstance(each, _PLAIN) for each in value)
    return isinstance(value, _PLAIN)


def _column(numbers: dict[str, int], names: Iterable[str]) -> bytes:
    return array("I", [numbers.setdefault(name, len(numbers)) for name in names]).tobytes()


def _world(tables: _Tables, library: Vocabulary) -> WorldState:
    classes = {**{term.iri: term for term in tables.own}, **library.classes}
    vocabulary = msgspec.structs.replace(library, prefixes=tables.prefixes, classes=classes)
    sets = [tuple(each) for each in tables.classes]
    individuals, of = tables.types
    types = dict(zip(_named(individuals, tables.names), map(sets.__getitem__, _numbers(of)), strict=True))
    related = {
        iri: list(zip(_named(subjects, tables.names), _named(objects, tables.names), strict=True))
        for iri, (subjects, objects) in tables.related.items()
    }
    valued: Mapping[str, dict[str, Value | None]] = {
        iri: dict(zip(_named(owners, tables.names), values, strict=True))
        for iri, (owners, values) in tables.valued.items()
    }
    return build_world_state(vocabulary, FactTables(types, related, valued))


def _numbers(column: bytes) -> array[int]:
    found = array("I")
    found.frombytes(column)
    return found


def _named(column: bytes, names: list[str]) -> Iterable[str]:
    return map(names.__getitem__, _numbers(column))
