"""Cells: how they are, their pace, the end of a fault or a stop, and a stop of everything."""

from __future__ import annotations

from http import HTTPStatus

from skillc.contract.cell import CellStatus, PaceSetting
from skillc.contract.messages import Acknowledge, Message, SetPace
from skillc.contract.stopping import StopReason
from skillc.server.endpoint import ApiCall, ApiEndpoint
from skillc.server.outcome import UNAVAILABLE, command_cell


async def list_cells(call: ApiCall) -> tuple[CellStatus, ...]:
    return tuple(cell.status for cell in call.server.cells.values())


async def show_cell(call: ApiCall) -> CellStatus:
    return call.server.find_cell(call.path["cell"]).status


async def set_pace(call: ApiCall) -> CellStatus:
    return await _request(call, SetPace(factor=call.body.factor))


async def acknowledge_fault(call: ApiCall) -> CellStatus:
    return await _request(call, Acknowledge())


async def stop_cell(call: ApiCall) -> CellStatus:
    cell = call.server.find_cell(call.path["cell"])
    cell.stop(f"{call.client.name}: {call.body.shown}")
    return cell.status


async def _request(call: ApiCall, message: Message) -> CellStatus:
    cell = call.server.find_cell(call.path["cell"])
    await command_cell(call, cell, message)
    return cell.status


NOT_FOUND, CONFLICT = HTTPStatus.NOT_FOUND, HTTPStatus.CONFLICT
ENDPOINTS = (
    ApiEndpoint("GET", "/cells", "view", "List the cells", list_cells, tuple[CellStatus, ...]),
    ApiEndpoint("GET", "/cells/{cell}", "view", "Show a cell", show_cell, CellStatus, refusals=(NOT_FOUND,)),
    ApiEndpoint(
        "PUT",
        "/cells/{cell}/pace",
        "operate",
        "Set the pace of a cell",
        set_pace,
        CellStatus,
        body=PaceSetting,
        refusals=(NOT_FOUND, CONFLICT, *UNAVAILABLE),
    ),
    ApiEndpoint(
        "POST",
        "/cells/{cell}/acknowledge",
        "operate",
        "Let a cell take operations again after a fault or a stop whose cause is removed",
        acknowledge_fault,
        CellStatus,
        refusals=(NOT_FOUND, CONFLICT, *UNAVAILABLE),
    ),
    ApiEndpoint(
        "POST",
        "/cells/{cell}/stop",
        "view",
        "Stop all operations of a cell",
        stop_cell,
        CellStatus,
        body=StopReason,
        needs_body=False,
        refusals=(NOT_FOUND,),
        unlimited=True,
    ),
)
