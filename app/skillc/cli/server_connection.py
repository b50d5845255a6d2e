"""Which server the options of a command name, and the connection to it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from skillc.cli.options import PATH, grouped_option

if TYPE_CHECKING:
    from skillc.client.cell import ServerCell
    from skillc.client.server import Server

SERVER = "Server"
URL, TOKEN_FILE, CELL = "skillc.cli.server", "skillc.cli.token_file", "skillc.cli.cell"
"""Where the context of a command keeps what its options name."""
Function = TypeVar("Function", bound=Callable[..., Any])


def server_options(function: Function) -> Function:
    """Add `--server` and `--token-file`, which `connect_server` reads."""
    url = grouped_option(
        SERVER,
        "--server",
        metavar="URL",
        help="The server; by default that of SKILLC_SERVER, or http://127.0.0.1:8421.",
        expose_value=False,
        callback=lambda context, _, value: keep_choice(context, URL, value),
    )
    file = grouped_option(
        SERVER,
        "--token-file",
        type=PATH,
        help="The file with the token; by default that of SKILLC_TOKEN, or of the server in `.skillc`.",
        expose_value=False,
        callback=lambda context, _, value: keep_choice(context, TOKEN_FILE, value),
    )
    return url(file(function))


def asks_cell() -> bool:
    """Whether the options of the command name a cell or a server, so that it is a client."""
    meta = click.get_current_context().meta
    return CELL in meta or URL in meta


@contextmanager
def asked_cell() -> Iterator[ServerCell]:
    """Return the cell that the options of the command name, in a `with` statement; errors as of `skillc.connect`."""
    with connect_server() as server:
        yield server.cell(click.get_current_context().meta.get(CELL))


@contextmanager
def connect_server() -> Iterator[Server]:
    """Return the server that the options of the command name, in a `with` statement; errors as of `skillc.connect`."""
    from skillc.client.address import read_token_file
    from skillc.client.connecting import connect

    meta = click.get_current_context().meta
    url, file = meta.get(URL), meta.get(TOKEN_FILE)
    with connect(url, read_token_file(file) if file is not None else None) as server:
        yield server


def keep_choice(context: click.Context, name: str, value: str | Path | None) -> None:
    """Keep what an option of a command names."""
    if value is not None:
        context.meta[name] = value
