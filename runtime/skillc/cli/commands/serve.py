"""Start a server, which runs cells and serves the API to clients.

Each cell is a process of its own, which the server starts again if it dies. What happens is written to the state folder
before anything moves, so it survives both.
"""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.options import FOLDER, PATH

if TYPE_CHECKING:
    from skillc.services.backends import BackendName

DEFAULT_BIND = "127.0.0.1:8421"
EXAMPLES = """
skillc serve my_project --cell cell.ttl
skillc serve wiping --cell iiwa_table.ttl --backend kinematic
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("library", type=PATH, default=Path())
@click.option("--cell", "scenes", type=PATH, multiple=True, help="A scene to run as a cell. Can be repeated.")
@click.option("--bind", default=DEFAULT_BIND, show_default=True, metavar="HOST:PORT", help="Listen to this address.")
@click.option("--state", type=FOLDER, default=Path(".skillc"), show_default=True, help="Keep the state in this folder.")
@click.option(
    "--backend",
    type=click.Choice(("mujoco", "kinematic")),
    default="mujoco",
    show_default=True,
    help="Simulate with physics, or with ideal motion and contact.",
)
@click.option(
    "--seed", default=0, show_default=True, help="Seed of the differences between world model and simulation."
)
def command(library: Path, scenes: tuple[Path, ...], bind: str, state: Path, backend: BackendName, seed: int) -> None:
    """Serve the cells with the skills of LIBRARY, by default the project here."""
    if find_spec("uvicorn") is None:
        raise click.UsageError("the server needs uvicorn and starlette: pip install 'skillc[server]'")
    from skillc.cli.console import Terminal
    from skillc_runtime.platforms.processes import INHERITS_SOCKETS

    if not INHERITS_SOCKETS:
        raise click.UsageError("`skillc serve` needs Linux or macOS: processes of Windows inherit no sockets")
    from skillc.server.cells import choose_cells
    from skillc.server.serve import serve

    host, _, port = bind.rpartition(":")
    if not host or not port.isdecimal() or int(port) > 65535:
        raise click.UsageError(f"--bind {bind}: write HOST:PORT, such as {DEFAULT_BIND}")
    cells = choose_cells(library, scenes, state, backend, seed)
    serve(cells, host.strip("[]"), int(port), state, Terminal())
