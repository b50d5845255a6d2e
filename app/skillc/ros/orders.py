"""What can be asked of a cell by a topic or a service of ROS 2, and what is answered."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Literal, TypeAlias, assert_never

import msgspec

from skillc.client.async_cell import AsyncCell
from skillc.client.async_operation import AsyncOperation
from skillc.errors import RequestError, SkillcError
from skillc_runtime.recording import commands

Word: TypeAlias = Literal["start", "pause", "resume", "stop", "acknowledge"]
REASON = "requested by ROS 2"
COMMANDS: Mapping[Literal["pause", "resume", "stop"], commands.Command] = MappingProxyType(
    {"pause": commands.PauseRun(REASON), "resume": commands.Resume(), "stop": commands.Stop(REASON)}
)


class CellOrder(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """An order: `start` needs a task, a goal or a call, unless the cell has done something before.

    `operation` is the one that is meant by `pause`, `resume` and `stop`: the only one that goes on if it is empty; of
    `stop` all of the cell. `id` comes back in the answer.
    """

    command: Word
    task: str | None = None
    goal: str | None = None
    call: str | None = None
    arguments: dict[str, Any] = {}
    operation: str = ""
    id: str = ""


class OrderAnswer(msgspec.Struct, frozen=True):
    """Whether an order was carried out; `message` says why not. `operation` is the one that was started or meant."""

    success: bool
    message: str = ""
    operation: str = ""
    id: str = ""


async def carry_out(order: CellOrder, cell: AsyncCell) -> OrderAnswer:
    """Carry out an order; what the server refuses is the message of the answer."""
    try:
        operation = await _carry_out(order, cell)
    except SkillcError as error:
        return OrderAnswer(False, str(error), order.operation, order.id)
    return OrderAnswer(True, "", operation, order.id)


def read_order(text: str) -> CellOrder | OrderAnswer:
    """Return the order that a JSON text is, or the answer that says why it is none."""
    try:
        return msgspec.json.decode(text, type=CellOrder)
    except msgspec.MsgspecError as error:
        return OrderAnswer(False, f"this is no order: {error}")


async def _carry_out(order: CellOrder, cell: AsyncCell) -> str:
    match order.command:
        case "start":
            return (await _start(order, cell)).id
        case "stop" if not order.operation:
            await cell.stop(REASON)
            return ""
        case "acknowledge":
            await cell.acknowledge()
            return ""
        case "pause" | "resume" | "stop":
            operation = await _find(order, cell)
            await operation.give(COMMANDS[order.command])
            return operation.id
        case never:
            assert_never(never)


async def _start(order: CellOrder, cell: AsyncCell) -> AsyncOperation:
    wanted: dict[str, Any] = {"goal": order.goal, "call": order.call, "arguments": order.arguments}
    task = order.task
    if not (task or order.goal or order.call):
        last = await cell.operations(limit=1)
        if not last:
            raise RequestError(f"{cell.name} has done nothing yet: publish what to start, such as a task, as an order")
        request = last[0].status.request
        task, wanted = request.task, {"goal": request.goal, "call": request.call, "arguments": request.arguments}
    return await cell.start(task, **{name: value for name, value in wanted.items() if value})


async def _find(order: CellOrder, cell: AsyncCell) -> AsyncOperation:
    """Return the operation that is meant; RequestError if there is none such, or several."""
    ongoing = await cell.operations(ongoing=True)
    found = [each for each in ongoing if order.operation in ("", each.id)]
    if len(found) == 1:
        return found[0]
    if not ongoing:
        raise RequestError(f"{cell.name} has no ongoing operation")
    names = ", ".join(each.id for each in ongoing)
    which = f"{cell.name} has no ongoing operation {order.operation}" if order.operation else "name an operation"
    raise RequestError(f"{which}; ongoing in {cell.name}: {names}")
