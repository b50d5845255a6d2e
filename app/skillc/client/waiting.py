"""What the clients of programs that wait have of their own; their other methods are made from those with asyncio."""

from __future__ import annotations

from types import TracebackType
from typing import Self

from skillc.client.async_cell import AsyncCell
from skillc.client.async_operation import AsyncOperation
from skillc.client.async_server import AsyncServer
from skillc.client.loop_thread import LoopThread
from skillc.contract.cell import CellStatus, Lease
from skillc.contract.operation import ContactState, OperationStatus, State
from skillc.events import Prompt


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
