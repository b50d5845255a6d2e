"""Checkpoints of simulated cells, and a reset to the scene."""

from __future__ import annotations

import asyncio
from contextlib import closing
from http import HTTPStatus

from skillc.cells.journal.reading import find_checkpoint
from skillc.contract.cell import CellCheckpoint, CellStatus
from skillc.contract.messages import Forget, Reset, Restore, Save
from skillc.errors import RequestError
from skillc.server.context import open_journal
from skillc.server.http.api_call import ApiCall
from skillc.server.http.outcome import command_named_cell
from skillc.server.problems import ApiRefusal
from skillc.server.supervisor import CellSupervisor


async def reset_cell(call: ApiCall) -> CellStatus:
    return await command_named_cell(call, Reset(who=call.client.name, why=call.body.why))


async def list_checkpoints(call: ApiCall) -> tuple[CellCheckpoint, ...]:
    return await asyncio.to_thread(_read_checkpoints, call.server.find_cell(call.path["cell"]))


async def save_cell(call: ApiCall) -> CellCheckpoint:
    await command_named_cell(call, Save(name=call.body.name, who=call.client.name))
    return await _find_checkpoint(call, call.body.name)


async def restore_cell(call: ApiCall) -> CellStatus:
    found = await _find_checkpoint(call, call.path["checkpoint"])
    return await command_named_cell(call, Restore(name=found.name, who=call.client.name, why=call.body.why))


async def remove_checkpoint(call: ApiCall) -> None:
    found = await _find_checkpoint(call, call.path["checkpoint"])
    await command_named_cell(call, Forget(name=found.name))


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
