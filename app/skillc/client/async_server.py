"""A server, for programs with asyncio."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncGenerator
from types import TracebackType

from skillc.client.async_cell import AsyncCell
from skillc.client.async_operation import AsyncOperation
from skillc.client.calls import ServerCalls
from skillc.client.feed import Status, follow_states
from skillc.contract.access import NewToken, Role
from skillc.contract.api.endpoints import ADD_TOKEN, MAKE_LOGIN_CODE, SHOW_OPERATION
from skillc.errors import RequestError


class AsyncServer(ServerCalls):
    """A server; as a context manager it closes the connection. Errors are those of `AsyncOperation`.

    All is used in one event loop, that in which it is used first.
    """

    async def cell(self, name: str | None = None) -> AsyncCell:
        """Return a cell, or the only one. RequestError, with the cells, if there is none such, or several."""
        names = [each.name for each in await self.cells()]
        if name is None and len(names) == 1:
            return AsyncCell(self._connection, names[0])
        if name in names:
            return AsyncCell(self._connection, name)
        wanted = f"there is no cell `{name}`" if name is not None else "name a cell"
        raise RequestError(f"{wanted}; the server has {', '.join(sorted(names))}")

    async def operation(self, id: str | None = None) -> AsyncOperation:
        """Return an operation, or the only one that goes on. RequestError if there is none such, or several."""
        if id is not None:
            status = await self._connection.call(SHOW_OPERATION, id)
            return AsyncOperation(self._connection, status)
        match await self.ongoing():
            case (only,):
                return only
            case ():
                raise RequestError("no operation goes on; name one that has ended")
            case several:
                raise RequestError(f"name an operation: {', '.join(each.id for each in several)}")

    async def ongoing(self) -> tuple[AsyncOperation, ...]:
        """Return the operations of all cells that have not ended."""
        cells = [AsyncCell(self._connection, each.name) for each in await self.cells()]
        found = await asyncio.gather(*(each.operations(ongoing=True) for each in cells))
        return tuple(operation for operations in found for operation in operations)

    def watch(self) -> AsyncGenerator[Status, None]:
        """Yield how each cell and each operation that goes on is, and then what changes, until that is given up.

        Of several changes of the same only the last one may come; events of operations come all.
        """
        return follow_states(self._connection)

    async def add_token(self, name: str, role: Role, agent: bool = False) -> str:
        """Make a token for a client, and return it; nobody can read it again.

        What an `agent`, a program that decides by itself, submits waits for the approval of somebody else.
        """
        return (await self._connection.call(ADD_TOKEN, body=NewToken(name, role, agent))).token

    async def make_login_code(self) -> str:
        """Return a code that stands for the token of this client in one request, within a minute."""
        return (await self._connection.call(MAKE_LOGIN_CODE)).code

    async def close(self) -> None:
        """Close the connection; what goes on in the server goes on."""
        await self._connection.close()

    async def __aenter__(self) -> AsyncServer:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        await self.close()
