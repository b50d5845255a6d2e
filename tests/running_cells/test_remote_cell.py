"""A cell in a process of its own answers when things are durable, stops at once, and ends safely with its server."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, closing
from pathlib import Path

import msgspec

from running_cells.yard import write_yard
from skillc.cells.journal.reading import JournalReader
from skillc.cells.remote_cell import RemoteCell, start_cell
from skillc.cells.settings import CellSettings
from skillc.contract.messages import End, Give, Happened, Report, SetPace, StartFailed, StatusChanged, Submit
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc_runtime.recording.commands import PauseRun, Resume, Stop
from waiting import LONG_S

CARRY = OperationRequest(task="carry_all")


class Server:
    """What has been reported by a cell."""

    def __init__(self) -> None:
        self.reports: list[Report] = []
        self.news = asyncio.Event()

    def __call__(self, report: Report) -> None:
        self.reports.append(report)
        self.news.set()

    @property
    def operations(self) -> dict[str, OperationStatus]:
        """The operations as they were reported last."""
        return {each.operation.id: each.operation for each in self.reports if isinstance(each, Happened)}

    async def see(self, kind: type[Report]) -> Report:
        """Wait for a report of a kind."""
        while not (found := [each for each in self.reports if isinstance(each, kind)]):
            await self._hear()
        return found[-1]

    async def see_state(self, operation: str, state: str) -> OperationStatus:
        """Wait until an operation is in a state."""
        while operation not in self.operations or self.operations[operation].state != state:
            await self._hear()
        return self.operations[operation]

    async def _hear(self) -> None:
        self.news.clear()
        await asyncio.wait_for(self.news.wait(), LONG_S)


@asynccontextmanager
async def serving(settings: CellSettings) -> AsyncIterator[tuple[RemoteCell, Server]]:
    """Start a cell, and end it."""
    server = Server()
    with Path(settings.folder).with_name("log").open("w") as log:
        cell = await start_cell(settings, log, server)
    try:
        yield cell, server
    finally:
        if not cell.gone.done():
            await cell.request(End(reason="the test ends"))
        await asyncio.wait_for(cell.gone, LONG_S)


def test_a_cell_is_operated_says_what_it_cannot_do_and_comes_to_rest_without_its_server(tmp_path: Path) -> None:
    settings = write_yard(tmp_path)

    async def use() -> None:
        async with serving(settings) as (cell, server):
            await server.see(StatusChanged)
            await ask_what_cannot_be_done(cell, server)
            await operate(cell, server)
            await abandon(cell, server)

    asyncio.run(use())
    with closing(JournalReader(settings.journal)) as reader:
        last = reader.envelopes("left")[-1].event
    assert (last.status, last.failure.message) == ("interrupted", "the server of the cell has ended")


async def ask_what_cannot_be_done(cell: RemoteCell, server: Server) -> None:
    requests = {
        "there is no task `carry_none`": OperationRequest(task="carry_none"),
        "goal:1:1": OperationRequest(goal="lab:Nowhere contain lab:crate-0"),
        "exactly one of a task, a goal and a call": OperationRequest(),
        "there is no skill `Lift`": OperationRequest(task="carry_all", breakpoints=("Lift",)),
    }
    for number, (message, request) in enumerate(requests.items()):
        refused = (await cell.request(Submit(operation=f"op-{number}", request=request))).refused
        assert refused is not None and message in refused.describe(), refused
    assert server.operations == {}


async def operate(cell: RemoteCell, server: Server) -> None:
    assert (await cell.request(SetPace(factor=2.0))).refused is None
    assert (await cell.request(Submit(operation="op", request=CARRY))).refused is None
    refused = (await cell.request(Give(operation="op", command=Resume()))).refused
    assert refused is not None and refused.kind == "state" and "stop" in refused.allowed
    await server.see_state("op", "running")
    assert (await cell.request(Give(operation="op", command=PauseRun()))).refused is None
    await server.see_state("op", "paused")
    assert (await cell.request(Give(operation="op", command=Resume()))).refused is None
    cell.stop("enough", "op")
    ended = await server.see_state("op", "stopped")
    assert ended.failure is not None and ended.failure.message == "enough"
    again = (await cell.request(Submit(operation="op", request=CARRY))).refused
    assert again is not None and "already an operation op" in again.reason
    assert (await cell.request(Give(operation="op", command=Stop()))).refused is not None


async def abandon(cell: RemoteCell, server: Server) -> None:
    await cell.request(SetPace(factor=1.0))
    await cell.request(Submit(operation="left", request=CARRY))
    await server.see_state("left", "running")
    cell.abandon()
    assert await asyncio.wait_for(cell.gone, LONG_S) == 0


def test_a_scene_that_does_not_exist_is_reported(tmp_path: Path) -> None:
    settings = msgspec.structs.replace(write_yard(tmp_path), scene="nowhere.ttl")

    async def operate() -> None:
        server = Server()
        with (tmp_path / "log").open("w") as log:
            cell = await start_cell(settings, log, server)
        assert await asyncio.wait_for(cell.gone, LONG_S) == 1
        report = await server.see(StartFailed)
        assert "there is no file nowhere.ttl" in report.reason

    asyncio.run(operate())
