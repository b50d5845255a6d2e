"""The world of a cell: its facts, queries, edits, and who has written what."""

from __future__ import annotations

from functools import partial

from skillc.contract.messages import Edit, Place
from skillc.contract.world import (
    MAX_NUMBER,
    DocumentForm,
    FactPage,
    PlacedThing,
    QueryRows,
    StatableFacts,
    TermSubject,
    WorldEdit,
    WorldFacts,
    WorldPlacement,
    WorldText,
    WorldWrite,
    WritePage,
)
from skillc.server.asking import ask_about
from skillc.server.http.api_call import ApiCall
from skillc.server.http.outcome import command_cell
from skillc.workers import questions

QUERY_S = 10.0
"""How long the answer to a query may take."""


async def list_facts(call: ApiCall) -> WorldFacts:
    page: FactPage = call.query
    return await ask_about(call, partial(questions.list_facts, page), WorldFacts, QUERY_S)


async def write_world(call: ApiCall) -> WorldText:
    wanted: DocumentForm = call.query
    cell = call.server.find_cell(call.path["cell"]).settings.name
    return await ask_about(call, partial(questions.write_world, cell, wanted), WorldText, QUERY_S)


async def list_terms(call: ApiCall) -> StatableFacts:
    wanted: TermSubject = call.query
    return await ask_about(call, partial(questions.list_terms, wanted.subject), StatableFacts, QUERY_S)


async def list_things(call: ApiCall) -> tuple[PlacedThing, ...]:
    return await ask_about(call, questions.list_things, tuple[PlacedThing, ...], QUERY_S)


async def query_world(call: ApiCall) -> QueryRows:
    return await ask_about(call, partial(questions.query_world, call.body.sparql), QueryRows, QUERY_S)


async def edit_world(call: ApiCall) -> None:
    wanted: WorldEdit = call.body
    cell = call.server.find_cell(call.path["cell"])
    await command_cell(call, cell, Edit(edits=wanted.edits, who=call.client.name, why=wanted.why))


async def place_thing(call: ApiCall) -> None:
    wanted: WorldPlacement = call.body
    cell = call.server.find_cell(call.path["cell"])
    placed = Place(thing=wanted.thing, pose=wanted.pose, who=call.client.name, why=wanted.why)
    await command_cell(call, cell, placed)


async def list_writes(call: ApiCall) -> tuple[WorldWrite, ...]:
    page: WritePage = call.query
    journal = call.server.find_cell(call.path["cell"]).settings.journal
    before = MAX_NUMBER if page.before is None else page.before
    return await ask_about(
        call, partial(questions.list_writes, journal, before, page.limit), tuple[WorldWrite, ...], QUERY_S
    )
