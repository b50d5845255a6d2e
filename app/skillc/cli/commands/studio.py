"""Open the studio: see, understand and operate cells in a browser.

If no server uses the state folder, this starts one, which ends with Ctrl-C. Otherwise the page of the one that runs is
opened. The browser is logged in by a code in the address, which can be used once, within a minute; on a machine with
other users give --no-browser, and open the address that is printed, so that no list of processes shows it.
"""

from __future__ import annotations

import os
import socket
import webbrowser
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias
from urllib.parse import urlencode

import click

from skillc.cli.command import Command
from skillc.cli.serving import DEFAULT_BIND, cell_options, parse_address, require_server
from skillc_dsl.importing import importing

if TYPE_CHECKING:
    from skillc.services.project.backends import BackendName
    from skillc.services.tasks.studio_choice import StudioChoice

Show: TypeAlias = Callable[[str], None]
EXAMPLES = """
skillc studio clean_whiteboard
skillc studio sorting:sort_parts
skillc studio my_project --cell cell.ttl
skillc studio --no-browser
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("what", metavar="[LIBRARY|TASK]", required=False)
@cell_options
@click.option("--no-browser", is_flag=True, help="Print the address, with the code, instead of opening a browser.")
@click.option(
    "--bind",
    metavar="HOST:PORT",
    help=f"Listen to this address of this machine; by default {DEFAULT_BIND}, or another port if that is in use.",
)
def command(
    what: str | None,
    scenes: tuple[Path, ...],
    no_browser: bool,
    bind: str | None,
    state: Path,
    backend: BackendName,
    seed: int,
) -> None:
    """Open the page of a server in a browser; start the server if none runs here.

    A TASK, or LIBRARY:TASK, is chosen in the page. Without --cell there is a cell for the scene of the TASK, or for the
    scenes of the tasks of the LIBRARY, by default of the project here, or of the shipped wiping library.
    """
    require_server()
    from skillc.services.tasks.studio_choice import choose_studio

    show = _print_address if no_browser else _open_browser
    choice = choose_studio(what, scenes)
    running = _find_running(state, choice)
    if running is not None:
        show(running)
        return
    _serve(choice, bind, state, backend, seed, show)


def _find_running(state: Path, choice: StudioChoice) -> str | None:
    """Return the address of the page of the server that uses a state folder, with a code; None if none runs."""
    from skillc.client.address import read_address
    from skillc.client.connecting import connect
    from skillc.client.errors import UnavailableError
    from skillc.errors import RequestError

    address = read_address(state)
    if address is None:
        return None
    try:
        with connect(address, state=state) as server:
            cells = {each.name for each in server.cells()}
            wanted = [each.stem for each in choice.scenes] if choice.cell else []
            missing = [each for each in wanted if each not in cells]
            if missing:
                other = "end it, or give another --state FOLDER"
                raise RequestError(f"the server at {address} has no cell {missing[0]}; {other}")
            return _make_address(address, server.make_login_code(), choice)
    except UnavailableError:
        return None  # a server that was killed has left its address


def _serve(choice: StudioChoice, bind: str | None, state: Path, backend: BackendName, seed: int, show: Show) -> None:
    """Serve, and show the page as soon as it can be loaded, until Ctrl-C."""
    with importing():
        from skillc.cli.console import Terminal
        from skillc.client.address import ADMIN_TOKEN, read_token
        from skillc.server.cells import choose_cells
        from skillc.server.context import ServerContext
        from skillc.server.http.listening import Listening
        from skillc.server.serve import serve
        from skillc.server.state import open_state

    def show_page(server: ServerContext, address: str) -> None:
        client = server.state.tokens.find(read_token(state / ADMIN_TOKEN) or "")
        assert client is not None, "the state has made the token"
        show(_make_address(address, server.codes.make(client.token), choice))

    listening = Listening(*(parse_address(bind) if bind is not None else _find_port()))
    served = choose_cells((choice.library,), choice.scenes, state, backend, seed)
    serve(served, listening, open_state(state), Terminal(), show_page)


def _find_port() -> tuple[str, int]:
    """Return the default address, with any free port if its own is in use."""
    host, port = parse_address(DEFAULT_BIND)
    with socket.socket() as probe:
        return (host, 0) if probe.connect_ex((host, port)) == 0 else (host, port)


def _make_address(address: str, code: str, choice: StudioChoice) -> str:
    """Return the address of the page; what follows its `#`, as `studio/src/state/address.ts` reads it, is not sent."""
    about = {"code": code, "cell": choice.cell, "task": choice.task}
    return f"{address}/#{urlencode({name: value for name, value in about.items() if value})}"


def _open_browser(address: str) -> None:
    """Open the address in a browser; print it if there is none, or only one for the terminal."""
    from skillc_runtime.platforms.display import has_display

    if not (has_display() or "BROWSER" in os.environ) or not webbrowser.open(address):
        _print_address(address)


def _print_address(address: str) -> None:
    click.echo(address)
