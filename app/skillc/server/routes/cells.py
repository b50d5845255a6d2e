"""Cells: how they are, their pace, the end of a fault or a stop, and a stop of everything."""

from __future__ import annotations

from skillc.contract.cell import CellStatus
from skillc.contract.messages import Acknowledge, SetPace
from skillc.server.http.api_call import ApiCall
from skillc.server.http.outcome import command_named_cell


async def list_cells(call: ApiCall) -> tuple[CellStatus, ...]:
    return tuple(cell.status for cell in call.server.cells.values())


async def show_cell(call: ApiCall) -> CellStatus:
    return call.server.find_cell(call.path["cell"]).status


async def set_pace(call: ApiCall) -> CellStatus:
    return await command_named_cell(call, SetPace(factor=call.body.factor))


async def acknowledge_fault(call: ApiCall) -> CellStatus:
    return await command_named_cell(call, Acknowledge())


async def stop_cell(call: ApiCall) -> CellStatus:
    cell = call.server.find_cell(call.path["cell"])
    cell.stop(f"{call.client.name}: {call.body.shown}")
    return cell.status
