"""Connects to a server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc.client.address import find_address
from skillc.extras import require
from skillc.values.arguments import AnyPath, optional_path, optional_text

if TYPE_CHECKING:
    from skillc.client.async_server import AsyncServer
    from skillc.client.server import Server


def connect(url: str | None = None, token: str | None = None, state: AnyPath | None = None) -> Server:
    """Return a server, for programs that wait for its answers.

    Without `url`, it is that of the environment variable SKILLC_SERVER, or http://127.0.0.1:8421; without `token`, that
    of SKILLC_TOKEN. A server on this machine gets the token of the command line in the folder `state`, by default
    `.skillc`, if no other is given.

    RequestError if there is no token, or the server refuses it; SkillcError if no server answers, or the extra
    `server` is not installed.
    """
    require("a client of a server", "server")
    from skillc.client.server import Server

    server = Server(connect_async(url, token, state))
    try:
        server.cells()
    except BaseException:
        server.close()
        raise
    return server


def connect_async(url: str | None = None, token: str | None = None, state: AnyPath | None = None) -> AsyncServer:
    """Return a server, for programs with asyncio; the parameters are those of `connect`, and so are the errors.

    That no server answers is found with the first request.
    """
    require("a client of a server", "server")
    from skillc.client.async_server import AsyncServer
    from skillc.client.connection import Connection

    folder = optional_path(state, "the state folder")
    address = find_address(optional_text(url, "the address"), optional_text(token, "the token"), folder)
    return AsyncServer(Connection(address))
