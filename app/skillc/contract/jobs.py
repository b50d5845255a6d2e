"""What a worker can be asked about a snapshot of a cell, and what it answers."""

from __future__ import annotations

from typing import TypeAlias

import msgspec

from skillc.contract.diagnosis import NO_DIAGNOSIS, Diagnosis
from skillc.contract.world import WorldFormat


class QueryWorld(msgspec.Struct, frozen=True, tag="query"):
    """Answer a SPARQL query over the facts, the data sheets, the vocabulary and the skills of the library."""

    sparql: str


class ListFacts(msgspec.Struct, frozen=True, tag="facts"):
    """List the stated facts about the individuals of a class, or about one, but not those of data sheets.

    Names are IRIs or `prefix:name`; None stands for all. With `words`, those whose names, labels, classes or texts
    contain them.
    """

    subject: str | None
    cls: str | None
    words: str | None
    offset: int
    limit: int


class WriteWorld(msgspec.Struct, frozen=True, tag="write-world"):
    """Write the world of the cell of a name in a format; RDF with the facts of data sheets if `everything`."""

    cell: str
    format: WorldFormat
    everything: bool


class ListTerms(msgspec.Struct, frozen=True, tag="terms"):
    """List the relations and properties that facts about an individual may have."""

    subject: str


class ListThings(msgspec.Struct, frozen=True, tag="things"):
    """List the things that have a pose of their own or a size."""


class ListWrites(msgspec.Struct, frozen=True, tag="writes"):
    """List the last writes before a number, the last one first, from the journal of the cell."""

    journal: str
    before: int
    limit: int


class ListDevices(msgspec.Struct, frozen=True, tag="devices"):
    """List the devices of the cell."""


class ListPoses(msgspec.Struct, frozen=True, tag="poses"):
    """List where the individuals of the cell are in the world, but not those of data sheets."""


class CheckOperation(msgspec.Struct, frozen=True, tag="check"):
    """Check that an operation could be submitted now; its values are those of an OperationRequest."""

    task: str | None
    goal: str | None
    call: str | None
    arguments: dict[str, str]
    breakpoints: tuple[str, ...]


WorldJob: TypeAlias = QueryWorld | ListFacts | WriteWorld | ListTerms | ListThings | ListWrites | ListPoses
Job: TypeAlias = WorldJob | ListDevices | CheckOperation


class JobRefused(msgspec.Struct, frozen=True):
    """Why a job cannot be done; `why` is empty if a `diagnosis` says more."""

    why: str = ""
    diagnosis: Diagnosis = NO_DIAGNOSIS
