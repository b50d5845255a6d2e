"""What the clients of programs that wait have of their own; their other methods are made from those with asyncio."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncGenerator, Coroutine, Iterator
from concurrent.futures import wait
from types import AsyncGeneratorType, TracebackType
from typing import Any, Self, TypeVar

from skillc.client.async_cell import AsyncCell
from skillc.client.async_operation import AsyncOperation
from skillc.client.async_server import AsyncServer
from skillc.contract.cell import CellStatus, Lease
from skillc.contract.operation import ContactState, OperationStatus, State
from skillc.events import Prompt

LOOK_S = 0.1
"""How often a waiting thread looks again, so that it takes interrupts, in s of wall time."""
TIDY_UP_S = 5.0
"""How long a coroutine that is cancelled may take to tidy up, in s."""
T = TypeVar("T")


class WaitingServer:
    """A server, and the loop in which its requests are made."""

    def __init__(self, server: AsyncServer) -> None:
        self._loop, self._client = LoopThread(), server

    def close(self) -> None:
        """Close the connection; what goes on in the server goes on."""
        self._loop.run(self._client.close())
        self._loop.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()


class WaitingCell:
    """A cell, and the loop in which its requests are made. Its properties ask the server each time, but for `name`."""

    def __init__(self, loop: LoopThread, cell: AsyncCell) -> None:
        self._loop, self._client = loop, cell

    @property
    def name(self) -> str:
        """Its name, which no other cell of the server has."""
        return self._client.name

    @property
    def status(self) -> CellStatus:
        """How it is now."""
        return self._loop.run(self._client.status())

    @property
    def lease(self) -> Lease:
        """Who alone may command it now."""
        return self._loop.run(self._client.lease())


class WaitingOperation:
    """An operation, and the loop in which its requests are made."""

    def __init__(self, loop: LoopThread, operation: AsyncOperation) -> None:
        self._loop, self._client = loop, operation

    @property
    def id(self) -> str:
        """Its id, which no other has."""
        return self._client.id

    @property
    def task(self) -> str:
        """The name of its task, or the text of its goal or call."""
        return self._client.task

    @property
    def status(self) -> OperationStatus:
        """How it is now."""
        return self._loop.run(self._client.refresh())

    @property
    def last_status(self) -> OperationStatus:
        """How it was when it was last heard of, without asking the server."""
        return self._client.status

    @property
    def state(self) -> State:
        """Its state: queued, planning, planned, running, pausing, paused, stopping, or one in which it has ended."""
        return self.status.state

    @property
    def reason(self) -> str:
        """Why it is in its state, or for what it waits; empty if there is nothing to say."""
        return self.status.reason

    @property
    def contact(self) -> ContactState:
        """What becomes of a tool that pressed when it was paused: `kept`, `lifting`, `taken-off` or `approaching`.

        `none` if no tool pressed, or while the run is not paused.
        """
        return self.status.contact

    @property
    def allowed(self) -> tuple[str, ...]:
        """The names of the commands that its state allows."""
        return self.status.allowed

    @property
    def ended(self) -> bool:
        """Whether it has ended."""
        self._loop.run(self._client.refresh())
        return self._client.ended

    @property
    def prompts(self) -> tuple[Prompt, ...]:
        """What its skills ask operators: `text`, `choices`, and until when, in s of the cell's clock."""
        return self.status.prompts

    @property
    def breakpoints(self) -> tuple[str, ...]:
        """Before which calls it pauses, each SKILL or FILE:LINE."""
        return self.status.breakpoints


class LoopThread:
    """A thread with an event loop; `run` and `iterate` may be called from any other thread."""

    def __init__(self) -> None:
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, name="skillc client", daemon=True)
        self._thread.start()

    def run(self, coroutine: Coroutine[Any, Any, T]) -> T:
        """Return the value of a coroutine; an interrupt of the thread that waits cancels it, and lets it tidy up."""
        ended = threading.Event()

        async def carry_out() -> T:
            try:
                return await coroutine
            finally:
                ended.set()

        future = asyncio.run_coroutine_threadsafe(carry_out(), self._loop)
        try:
            while not future.done():
                wait((future,), LOOK_S)
            return future.result(0.0)
        finally:
            if future.cancel():
                ended.wait(TIDY_UP_S)

    def iterate(self, items: AsyncGenerator[T, None]) -> Iterator[T]:
        """Yield what an asynchronous generator yields, and close it at the end."""
        try:
            while True:
                yield self.run(_next(items))
        except StopAsyncIteration:
            return
        finally:
            if not self._loop.is_closed():
                self.run(_close(items))

    def close(self) -> None:
        """End the thread, and what goes on in it."""
        self.run(_end_tasks())
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()  # wait ends: with the loop, which is stopped and has no tasks
        self._loop.close()


async def _next(items: AsyncGenerator[T, None]) -> T:
    return await anext(items)


async def _close(items: AsyncGenerator[Any, None]) -> None:
    """Close a generator, once it has stopped after an interrupt cancelled it."""
    assert isinstance(items, AsyncGeneratorType), "what `async def` with `yield` returns"
    while items.ag_running:  # wait ends: it was cancelled, and stops in the next round of the loop
        await asyncio.sleep(0.0)
    await items.aclose()


async def _end_tasks() -> None:
    """Cancel all other tasks, and close the generators that are open."""
    tasks = asyncio.all_tasks() - {asyncio.current_task()}
    for each in tasks:
        each.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
    await asyncio.get_running_loop().shutdown_asyncgens()
