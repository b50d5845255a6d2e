"""A server."""

from __future__ import annotations

from collections.abc import Iterator
from types import TracebackType

from skillc.client.async_server import AsyncServer
from skillc.client.cell import ServerCell
from skillc.client.feed import Status
from skillc.client.loop_thread import LoopThread
from skillc.client.operation import ServerOperation
from skillc.contract.access import Role, TokenInfo
from skillc.contract.cell import CellStatus
from skillc.contract.library import LibraryStatus
from skillc.contract.version import VersionInfo


class Server:
    """A server; its methods are those of `AsyncServer`, and wait. They may be called from any thread.

    As a context manager it closes the connection; what goes on in the server goes on.
    """

    def __init__(self, server: AsyncServer) -> None:
        self._loop, self._server = LoopThread(), server

    def version(self) -> VersionInfo:
        """Return its version of skillc and of the API."""
        return self._loop.run(self._server.version())

    def libraries(self) -> tuple[LibraryStatus, ...]:
        """Return its libraries, and why one on disk is not used."""
        return self._loop.run(self._server.libraries())

    def cells(self) -> tuple[CellStatus, ...]:
        """Return how its cells are."""
        return self._loop.run(self._server.cells())

    def cell(self, name: str | None = None) -> ServerCell:
        """Return a cell, or the only one. RequestError, with the cells, if there is none such, or several."""
        return ServerCell(self._loop, self._loop.run(self._server.cell(name)))

    def operation(self, id: str | None = None) -> ServerOperation:
        """Return an operation, or the only one that goes on. RequestError if there is none such, or several."""
        return ServerOperation(self._loop, self._loop.run(self._server.operation(id)))

    def ongoing(self) -> tuple[ServerOperation, ...]:
        """Return the operations of all cells that have not ended."""
        return tuple(ServerOperation(self._loop, each) for each in self._loop.run(self._server.ongoing()))

    def watch(self) -> Iterator[Status]:
        """Yield how each cell and each operation that goes on is, and then what changes, until that is given up."""
        return self._loop.iterate(self._server.watch())

    def tokens(self) -> tuple[TokenInfo, ...]:
        """Return the tokens of its clients, without their secrets."""
        return self._loop.run(self._server.tokens())

    def add_token(self, name: str, role: Role, agent: bool = False) -> str:
        """Make a token for a client, and return it; nobody can read it again.

        What an `agent`, a program that decides by itself, submits waits for the approval of somebody else.
        """
        return self._loop.run(self._server.add_token(name, role, agent))

    def revoke_token(self, name: str) -> None:
        """Refuse all further requests with a token."""
        self._loop.run(self._server.revoke_token(name))

    def make_login_code(self) -> str:
        """Return a code that stands for the token of this client in one request, within a minute."""
        return self._loop.run(self._server.make_login_code())

    def close(self) -> None:
        """Close the connection; what goes on in the server goes on."""
        self._loop.run(self._server.close())
        self._loop.close()

    def __enter__(self) -> Server:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()
