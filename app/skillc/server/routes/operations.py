"""Operations: submitting them, giving them commands, and what has happened in them."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from contextlib import closing
from http import HTTPStatus

from msgspec import structs

from skillc.cells.journal.reading import LATEST_NS
from skillc.contract.commands import OperatorCommand
from skillc.contract.messages import Give, Refused, Submit
from skillc.contract.operation import OperationStatus
from skillc.contract.runs.history import HistoryPage
from skillc.server.context import open_journal
from skillc.server.http.api_call import ApiCall
from skillc.server.http.outcome import check_lease, command_cell, raise_refused, sign_request
from skillc.server.idempotency import KeyReused
from skillc.server.problems import KEY_REUSED, ApiRefusal
from skillc.server.supervisor import CellSupervisor
from skillc_runtime.recording import commands
from skillc_runtime.recording.envelope import Envelope, make_run_id
from skillc_runtime.recording.states import ENDS


async def list_operations(call: ApiCall) -> tuple[OperationStatus, ...]:
    cell = call.server.find_cell(call.path["cell"])
    if call.query.ongoing:
        return tuple(cell.operations.values())
    return await asyncio.to_thread(_read_history, cell, call.query, dict(cell.operations))


async def submit_operation(call: ApiCall) -> OperationStatus:
    cell = call.server.find_cell(call.path["cell"])
    check_lease(call, cell)
    operation = make_run_id(call.body.task or "operation")
    if call.key is None:
        return await _submit(call, cell, operation)
    async with call.server.keys.alone(call.client.name, call.key):
        first = _claim(call, b"\0".join((cell.settings.name.encode(), call.content)), operation)
        if call.server.has_operation(first):
            return call.server.find_operation(first)[1]
        return await _submit(call, cell, first)  # also one with a key that no cell has heard of, because one was off


async def show_operation(call: ApiCall) -> OperationStatus:
    return call.server.find_operation(call.path["operation"])[1]


async def give_command(call: ApiCall) -> OperationStatus:
    cell, operation = _find_running(call)
    if call.client.agent and isinstance(call.body, commands.Approve) and operation.request.owner == call.client.name:
        raise ApiRefusal(HTTPStatus.FORBIDDEN, "an agent cannot approve its own operation; somebody else has to")
    await command_cell(call, cell, Give(operation=operation.id, command=_sign(call.body, call.client.name)))
    return call.server.find_operation(operation.id)[1]


async def stop_operation(call: ApiCall) -> OperationStatus:
    cell, operation = call.server.find_operation(call.path["operation"])
    if operation.state not in ENDS:
        cell.stop(f"{call.client.name}: {call.body.shown}", operation.id)
    return operation


async def list_events(call: ApiCall) -> tuple[Envelope, ...]:
    cell, operation = call.server.find_operation(call.path["operation"])
    with closing(open_journal(cell)) as reader:
        return reader.envelopes(operation.id, call.query.after, call.query.limit)


async def _submit(call: ApiCall, cell: CellSupervisor, operation: str) -> OperationStatus:
    request = sign_request(call.body, call.client)
    answer = await cell.request(Submit(operation=operation, request=request))
    if isinstance(answer, Refused) and call.key is not None and answer.kind != "off":
        call.server.keys.release(call.client.name, call.key)
    raise_refused(answer)
    return call.server.find_operation(operation)[1]


def _claim(call: ApiCall, content: bytes, operation: str) -> str:
    assert call.key is not None
    try:
        return call.server.keys.claim(call.client.name, call.key, content, operation)
    except KeyReused as error:
        raise ApiRefusal(HTTPStatus.UNPROCESSABLE_ENTITY, str(error), kind=KEY_REUSED) from error


def _read_history(
    cell: CellSupervisor, page: HistoryPage, going_on: Mapping[str, OperationStatus]
) -> tuple[OperationStatus, ...]:
    """Return operations, the last one first; a search through a long history takes long, so this has a thread."""
    if not cell.settings.journal.exists():
        return ()
    with closing(open_journal(cell)) as reader:
        before_ns = LATEST_NS if page.before_ns is None else page.before_ns
        found = reader.latest(before_ns, page.limit, page.search.split())
    statuses = (each.ended or going_on.get(each.id) for each in found)
    return tuple(each for each in statuses if each is not None)


def _find_running(call: ApiCall) -> tuple[CellSupervisor, OperationStatus]:
    cell, operation = call.server.find_operation(call.path["operation"])
    if operation.state in ENDS:
        raise ApiRefusal(HTTPStatus.CONFLICT, f"the operation has {operation.state}; it takes no commands", ())
    return cell, operation


def _sign(command: OperatorCommand, who: str) -> commands.Command:
    """Return a command with who has given it."""
    return structs.replace(command, who=who)
