"""The queue of a cell: the operations that wait in it, and their order."""

from __future__ import annotations

from skillc.contract.messages import Reorder
from skillc.contract.operation import OperationStatus
from skillc.server.http.api_call import ApiCall
from skillc.server.http.outcome import command_cell


async def list_queue(call: ApiCall) -> tuple[OperationStatus, ...]:
    operations = call.server.find_cell(call.path["cell"]).operations.values()
    return tuple(sorted((each for each in operations if each.place), key=lambda each: each.place))


async def reorder_queue(call: ApiCall) -> tuple[OperationStatus, ...]:
    await command_cell(call, call.server.find_cell(call.path["cell"]), Reorder(first=call.body.first))
    return await list_queue(call)
