"""Questions about a cell that a process answers for what the cell knows.

What that needs is imported when one is answered, so that a server, which only passes them on, starts sooner.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias, assert_never

from skillc.contract.device import Device
from skillc.contract.sample import PoseNumbers
from skillc.contract.world import (
    DocumentForm,
    FactPage,
    PlacedThing,
    QueryRows,
    StatableFacts,
    WorldFact,
    WorldFacts,
    WorldText,
    WorldWrite,
)
from skillc_runtime.recording.run_spec import TaskRequest

if TYPE_CHECKING:
    from skillc.cells.snapshot import CellSnapshot
    from skillc_runtime.world.state.facts import Fact

Work: TypeAlias = Callable[..., object]
"""A function that can be pickled, of a CellSnapshot or nothing; its value is the answer. Such are these questions."""
MAX_ROWS = 10_000
"""How many rows of the answer to a query are returned."""


def check_operation(request: TaskRequest, breakpoints: tuple[str, ...], known: CellSnapshot) -> None:
    """Raise ServiceError for an operation that could not be submitted now."""
    from skillc.cells.operations.assigning import assign_request
    from skillc.services.tasks.breakpoints import parse_breakpoints

    assign_request(request.task, request.goal, request.call, request.arguments, known.library, known.state)
    parse_breakpoints(breakpoints, known.library)


def query_world(sparql: str, known: CellSnapshot) -> QueryRows:
    """Answer a SPARQL query over the facts, the data sheets, the vocabulary and the skills of the library."""
    from skillc.services.views.open_scenes import describe_state
    from skillc.services.views.scenes import query_document

    answer = query_document(describe_state("world", known.state), sparql, known.library, known.state)
    return QueryRows(known.sequence, answer.columns, answer.rows[:MAX_ROWS], len(answer.rows) > MAX_ROWS)


def list_facts(page: FactPage, known: CellSnapshot) -> WorldFacts:
    """List the stated facts that are asked for, but not those of data sheets unless about one individual."""
    facts = list(_find_facts(page, known))
    shown = facts[page.offset : page.offset + page.limit]
    return WorldFacts(known.sequence, len(facts), tuple(_describe(each, known) for each in shown))


def write_world(cell: str, form: DocumentForm, known: CellSnapshot) -> WorldText:
    """Write the world of the cell of a name in a form; ServiceError if that cannot state a fact."""
    from skillc.services.views.open_scenes import view_world
    from skillc.services.views.scene_export import export_scene
    from skillc.services.views.scene_show import draw_from_above
    from skillc.services.views.scenes import picture_scene
    from skillc_compiler.emit.picture.svg import draw_document

    scene = view_world(cell, known.library, known.state)
    match form.format:
        case "turtle" | "rdfxml" | "jsonld" | "ntriples" | "trig":
            text = export_scene(scene, form.format, form.everything)
        case "graph":
            text = draw_document(picture_scene(scene))
        case "top-view":
            text = draw_from_above(scene)
        case _:
            assert_never(form.format)
    return WorldText(known.sequence, text)


def list_terms(subject: str, known: CellSnapshot) -> StatableFacts:
    """List the relations and properties that facts about an individual may have."""
    from skillc.workers.terms import list_terms as list_of

    return list_of(subject, known.state, _find_shipped(known))


def list_things(known: CellSnapshot) -> tuple[PlacedThing, ...]:
    """List the things that have a pose of their own or a size."""
    from skillc.services.views.open_scenes import view_world
    from skillc.services.views.scene_show import list_placed

    return list_placed(view_world("world", known.library, known.state))


def list_writes(journal: Path, before: int, limit: int, known: CellSnapshot) -> tuple[WorldWrite, ...]:
    """List the last writes before a number, the last one first, from the journal of the cell."""
    from skillc.cells.journal.reading import JournalReader
    from skillc_runtime.world.state.labels.labelling import label_change

    with closing(JournalReader(journal)) as reader:
        found = reader.latest_writes(before, limit)
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


def list_devices(known: CellSnapshot) -> tuple[Device, ...]:
    """List the devices of the cell."""
    from skillc.workers.devices import list_devices as list_of

    return list_of(known.state)


def list_poses(known: CellSnapshot) -> dict[str, PoseNumbers]:
    """List the poses in the world that the facts give, by IRI, but not of the individuals of data sheets."""
    from skillc_runtime.world.space.frame_tree import FrameError
    from skillc_runtime.world.space.frames import pose

    found = dict[str, PoseNumbers]()
    for each in sorted(known.state.individuals - _find_shipped(known)):
        with suppress(FrameError):
            found[each] = pose(known.state, each).numbers
    return found


def _find_facts(page: FactPage, known: CellSnapshot) -> Iterator[Fact]:
    """Yield the stated facts that are asked for, by individual."""
    from skillc.services.views.open_scenes import view_world
    from skillc.services.views.scenes import find_individuals
    from skillc_runtime.world.state.elements import elements_of, find_elements
    from skillc_runtime.world.state.facts import ClassFact, PropertyFact, RelationFact
    from skillc_runtime.world.state.names import resolve_individual

    state = known.state
    if page.subject is not None:
        found = elements_of(state, [resolve_individual(page.subject, state)])
    else:
        shipped = _find_shipped(known)
        every = find_elements(state, page.type) if page.type is not None else elements_of(state, state.individuals)
        if page.search is not None:
            chosen = {each.iri for each in find_individuals(view_world("world", known.library, state), page.search)}
            every = tuple(each for each in every if each.iri in chosen)
        found = tuple(each for each in every if each.iri not in shipped)
    for each in found:
        if page.type is None or each.is_a(page.type):
            yield from (ClassFact(each.iri, cls) for cls in each.types)
            yield from (RelationFact(each.iri, relation, other) for relation, other in each.relations)
            yield from (PropertyFact(each.iri, value.property) for value in each.properties)


def _find_shipped(known: CellSnapshot) -> frozenset[str]:
    """Return the individuals of data sheets."""
    from skillc_runtime.scene.load import load_sheets

    return load_sheets(known.state.vocabulary).individuals


def _describe(fact: Fact, known: CellSnapshot) -> WorldFact:
    from skillc_runtime.world.state.labels.labelling import label_fact

    write = known.ledger.deciding_write(fact, known.state)
    labelled = label_fact(fact, known.state)
    return WorldFact(labelled) if write is None else WorldFact(labelled, write.evidence, write.origin)
