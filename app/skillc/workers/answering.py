"""What workers do: they answer one job after the other, each from a snapshot of a cell."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from pathlib import Path
from typing import TypeAlias, assert_never

import msgspec

from skillc.cells.database import DatabaseError
from skillc.cells.journal.reading import JournalReader
from skillc.cells.operations.assigning import assign_request
from skillc.cells.samples import list_numbers
from skillc.cells.snapshot import CellSnapshot, decode_snapshot
from skillc.contract.device import Device
from skillc.contract.jobs import (
    CheckOperation,
    Job,
    JobRefused,
    ListDevices,
    ListFacts,
    ListPoses,
    ListTerms,
    ListThings,
    ListWrites,
    QueryWorld,
    WorldJob,
    WriteWorld,
)
from skillc.contract.sample import PoseNumbers
from skillc.contract.world import PlacedThing, QueryRows, StatableFacts, WorldFact, WorldFacts, WorldText, WorldWrite
from skillc.errors import DiagnosticsError, ServiceError
from skillc.services.reporting.diagnosis import diagnose
from skillc.services.tasks.breakpoints import parse_breakpoints
from skillc.services.views.scene_show import list_placed
from skillc.services.views.scenes import describe_state, find_individuals, query_document, view_world
from skillc.workers.devices import list_devices
from skillc.workers.terms import list_terms
from skillc.workers.world_text import write_world
from skillc_runtime.scene.load import load_documents, sheet_documents
from skillc_runtime.scene.query import QueryError
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.elements import elements_of, find_elements
from skillc_runtime.world.state.facts import ClassFact, Fact, PropertyFact, RelationFact
from skillc_runtime.world.state.labels.labelling import label_change, label_fact
from skillc_runtime.world.state.names import NoSuchName, resolve_individual

MAX_ROWS = 10_000
"""How many rows of the answer to a query are returned."""

Work: TypeAlias = Callable[[CellSnapshot], object]
JobAnswer: TypeAlias = (
    QueryRows
    | WorldFacts
    | StatableFacts
    | WorldText
    | tuple[PlacedThing, ...]
    | tuple[WorldWrite, ...]
    | tuple[Device, ...]
    | dict[str, PoseNumbers]
    | None
)


def answer_job(request: tuple[Job | Work, bytes] | None) -> bytes | JobRefused:
    """Return the answer to a job for an encoded snapshot, as JSON, or why there is none; None asks if it is ready."""
    if request is None:
        return b""
    job, snapshot = request
    try:
        known = decode_snapshot(snapshot)
        return msgspec.json.encode(job(known) if callable(job) else _answer(job, known))
    except DiagnosticsError as error:
        return JobRefused(diagnosis=diagnose(error))
    except (ServiceError, QueryError, NoSuchName, DatabaseError) as error:
        return JobRefused(str(error))
    except MemoryError:
        return JobRefused("it needs too much memory; ask for less")


def _answer(job: Job, known: CellSnapshot) -> JobAnswer:
    if isinstance(job, WorldJob):
        return _answer_about_world(job, known)
    match job:
        case ListDevices():
            return list_devices(known.state)
        case CheckOperation():
            _check(job, known)
            return None
        case _:
            assert_never(job)


def _answer_about_world(job: WorldJob, known: CellSnapshot) -> JobAnswer:
    """Return the answer to a question about the world."""
    match job:
        case QueryWorld(sparql):
            return _query(sparql, known)
        case ListFacts():
            return _list_facts(job, known)
        case WriteWorld():
            return write_world(job, known)
        case ListTerms(subject):
            return list_terms(subject, known.state, _find_shipped(known))
        case ListThings():
            return list_placed(view_world("world", known.library, known.state))
        case ListWrites():
            return _list_writes(job, known)
        case ListPoses():
            return _list_poses(known)
        case _:
            assert_never(job)


def _check(job: CheckOperation, known: CellSnapshot) -> None:
    """Raise ServiceError for an operation that could not be submitted."""
    assign_request(job.task, job.goal, job.call, job.arguments, known.library, known.state)
    parse_breakpoints(job.breakpoints, known.library)


def _query(sparql: str, known: CellSnapshot) -> QueryRows:
    answer = query_document(describe_state("world", known.state), sparql, known.library, known.state)
    return QueryRows(known.sequence, answer.columns, answer.rows[:MAX_ROWS], len(answer.rows) > MAX_ROWS)


def _list_facts(job: ListFacts, known: CellSnapshot) -> WorldFacts:
    facts = list(_find_facts(job, known))
    shown = facts[job.offset : job.offset + job.limit]
    return WorldFacts(known.sequence, len(facts), tuple(_describe(each, known) for each in shown))


def _list_writes(job: ListWrites, known: CellSnapshot) -> tuple[WorldWrite, ...]:
    with closing(JournalReader(Path(job.journal))) as reader:
        found = reader.latest_writes(job.before, job.limit)
    return tuple(
        WorldWrite(
            sequence=each.transaction.sequence,
            written_ns=each.written_ns,
            origin=each.transaction.origin,
            evidence=each.evidence,
            changes=tuple(label_change(change, known.state.vocabulary) for change in each.transaction.changes),
            undo=tuple(label_change(change, known.state.vocabulary) for change in each.undo),
        )
        for each in found
    )


def _find_facts(job: ListFacts, known: CellSnapshot) -> Iterator[Fact]:
    """Yield the stated facts that are asked for, by individual."""
    state = known.state
    if job.subject is not None:
        found = elements_of(state, [resolve_individual(job.subject, state)])
    else:
        shipped = _find_shipped(known)
        every = find_elements(state, job.cls) if job.cls is not None else elements_of(state, state.individuals)
        if job.words is not None:
            chosen = {each.iri for each in find_individuals(view_world("world", known.library, state), job.words)}
            every = tuple(each for each in every if each.iri in chosen)
        found = tuple(each for each in every if each.iri not in shipped)
    for each in found:
        if job.cls is None or each.is_a(job.cls):
            yield from (ClassFact(each.iri, cls) for cls in each.types)
            yield from (RelationFact(each.iri, relation, other) for relation, other in each.relations)
            yield from (PropertyFact(each.iri, value.property) for value in each.properties)


def _list_poses(known: CellSnapshot) -> dict[str, PoseNumbers]:
    """Return the poses that the facts give, by IRI."""
    found = dict[str, PoseNumbers]()
    for each in sorted(known.state.individuals - _find_shipped(known)):
        with suppress(FrameError):
            found[each] = list_numbers(pose(known.state, each))
    return found


def _find_shipped(known: CellSnapshot) -> frozenset[str]:
    """Return the individuals of data sheets."""
    return load_documents(sheet_documents(), known.state.vocabulary).individuals


def _describe(fact: Fact, known: CellSnapshot) -> WorldFact:
    write = known.ledger.deciding_write(fact, known.state)
    labelled = label_fact(fact, known.state)
    return WorldFact(labelled) if write is None else WorldFact(labelled, write.evidence, write.origin)
