"""Cells: how they are, their pace, a reset, checkpoints, the end of a fault or a stop, and a stop of everything."""

from __future__ import annotations

import asyncio
from contextlib import closing
from http import HTTPStatus

from skillc.cells.journal.reading import find_checkpoint
from skillc.contract.cell import CellCheckpoint, CellStatus
from skillc.contract.messages import Acknowledge, Forget, Message, Reset, Restore, Save, SetPace
from skillc.errors import RequestError
from skillc.server.api_call import ApiCall
from skillc.server.context import open_journal
from skillc.server.outcome import command_cell
from skillc.server.problems import ApiRefusal
from skillc.server.supervisor import CellSupervisor


async def list_cells(call: ApiCall) -> tuple[CellStatus, ...]:
    return tuple(cell.status for cell in call.server.cells.values())


async def show_cell(call: ApiCall) -> CellStatus:
    return call.server.find_cell(call.path["cell"]).status


async def set_pace(call: ApiCall) -> CellStatus:
    return await _request(call, SetPace(factor=call.body.factor))


async def acknowledge_fault(call: ApiCall) -> CellStatus:
    return await _request(call, Acknowledge())


async def reset_cell(call: ApiCall) -> CellStatus:
    return await _request(call, Reset(who=call.client.name, why=call.body.why))


async def list_checkpoints(call: ApiCall) -> tuple[CellCheckpoint, ...]:
    return await asyncio.to_thread(_read_checkpoints, call.server.find_cell(call.path["cell"]))


async def save_cell(call: ApiCall) -> CellCheckpoint:
    await _request(call, Save(name=call.body.name, who=call.client.name))
    return await _find_checkpoint(call, call.body.name)


async def restore_cell(call: ApiCall) -> CellStatus:
    name = (await _find_checkpoint(call, call.path["checkpoint"])).name
    return await _request(call, Restore(name=name, who=call.client.name, why=call.body.why))


async def remove_checkpoint(call: ApiCall) -> None:
    await _request(call, Forget(name=(await _find_checkpoint(call, call.path["checkpoint"])).name))


async def stop_cell(call: ApiCall) -> CellStatus:
    cell = call.server.find_cell(call.path["cell"])
    cell.stop(f"{call.client.name}: {call.body.shown}")
    return cell.status


async def _request(call: ApiCall, message: Message) -> CellStatus:
    cell = call.server.find_cell(call.path["cell"])
    await command_cell(call, cell, message)
    return cell.status


def _read_checkpoints(cell: CellSupervisor) -> tuple[CellCheckpoint, ...]:
    if not cell.settings.journal.exists():
        return ()
    with closing(open_journal(cell)) as reader:
        return reader.checkpoints()


async def _find_checkpoint(call: ApiCall, name: str) -> CellCheckpoint:
    try:
        return find_checkpoint(name, await list_checkpoints(call), call.path["cell"])
    except RequestError as error:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, str(error)) from error
