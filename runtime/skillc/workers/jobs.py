"""What a worker can be asked about a snapshot of a cell, and what it answers."""

from __future__ import annotations

from typing import TypeAlias

import msgspec

from skillc_runtime.world.state.evidence import Evidence
from skillc_runtime.world.state.labelled import LabelledChange, LabelledFact


class QueryWorld(msgspec.Struct, frozen=True, tag="query"):
    """Answer a SPARQL query over the facts, the data sheets and the vocabulary."""

    sparql: str


class ListFacts(msgspec.Struct, frozen=True, tag="facts"):
    """List the stated facts about the individuals of a class, or about one, but not those of data sheets.

    Names are IRIs or `prefix:name`; None stands for all.
    """

    subject: str | None
    cls: str | None
    offset: int
    limit: int


class ListWrites(msgspec.Struct, frozen=True, tag="writes"):
    """List the last writes before a number, the last one first, from the journal of the cell."""

    journal: str
    before: int
    limit: int


class DescribeLibrary(msgspec.Struct, frozen=True, tag="library"):
    """Describe the library of the cell."""


class ListDevices(msgspec.Struct, frozen=True, tag="devices"):
    """List the devices of the cell."""


Job: TypeAlias = QueryWorld | ListFacts | ListWrites | DescribeLibrary | ListDevices


class WorldFact(msgspec.Struct, frozen=True, omit_defaults=True):
    """A fact, and how it is known: `evidence` is None for what the scene or a person stated, and by whom or what."""

    fact: LabelledFact
    evidence: Evidence | None = None
    origin: str = ""


class WorldFacts(msgspec.Struct, frozen=True):
    """Some of the `total` facts that were asked for, of the world after the write `sequence`."""

    sequence: int
    total: int
    facts: tuple[WorldFact, ...]


class WorldWrite(msgspec.Struct, frozen=True):
    """A write to the world: its number, when it was made, who or what made it, how that is known, and the changes.

    `written_ns` is the wall time in ns since 1970, 0 if it is not known; `evidence` is None for what a person states.
    """

    sequence: int
    written_ns: int
    origin: str
    evidence: Evidence | None
    changes: tuple[LabelledChange, ...]


class QueryRows(msgspec.Struct, frozen=True):
    """The answer to a query, of the world after the write `sequence`; `truncated` if there were more rows."""

    sequence: int
    columns: tuple[str, ...]
    rows: tuple[tuple[str | bool | int | float | None, ...], ...]
    truncated: bool = False
