"""Start a server, which runs cells and serves the API to clients.

Each cell is a process of its own, which the server starts again if it dies. What happens is written to the state folder
before anything moves, so it survives both.
"""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

import click
import msgspec

from skillc.cli.command import Command
from skillc.cli.options import PATH, grouped_option
from skillc.cli.serving import DEFAULT_BIND, cell_options, parse_address, require_ros2, require_server
from skillc.cli.struct_options import struct_options
from skillc_dsl.importing import importing

if TYPE_CHECKING:
    from skillc.server.http.listening import Listening
    from skillc.services.project.backends import BackendName

NETWORK = "Network"
EXAMPLES = """
skillc serve my_project --cell cell.ttl
skillc serve wiping --cell iiwa_table.ttl --backend kinematic
skillc serve wiping --cell iiwa_table.ttl --ros2
skillc serve --bind 0.0.0.0:8421 --host cells.example.org:8421 --tls-cert chain.pem --tls-key key.pem
"""


class NetworkOptions(msgspec.Struct, frozen=True, kw_only=True):
    """How clients reach a server."""

    bind: str
    names: tuple[str, ...]
    tls_cert: Path | None
    tls_key: Path | None
    proxy: str | None
    ros2: bool


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("libraries", metavar="[LIBRARY]..", type=PATH, nargs=-1)
@cell_options
@click.option("--bind", default=DEFAULT_BIND, show_default=True, metavar="HOST:PORT", help="Listen to this address.")
@click.option("--token-file", type=PATH, help="Keep the token of the command line in this file.")
@click.option("--log", "log_file", type=PATH, help="Write what is requested to this file, as JSON lines.")
@grouped_option(
    NETWORK, "--host", "names", multiple=True, metavar="NAME", help="A name that clients use for the server."
)
@grouped_option(NETWORK, "--tls-cert", type=PATH, help="Encrypt with this certificate and its chain (PEM).")
@grouped_option(NETWORK, "--tls-key", type=PATH, help="The key of the certificate (PEM).")
@grouped_option(NETWORK, "--ros2", is_flag=True, help="Publish the cells in ROS 2, and take orders there.")
@grouped_option(NETWORK, "--behind-proxy", "proxy", metavar="ADDRESS", help="Take requests from this proxy only.")
@struct_options(NetworkOptions)
def command(
    network: NetworkOptions,
    libraries: tuple[Path, ...],
    scenes: tuple[Path, ...],
    state: Path,
    backend: BackendName,
    seed: int,
    token_file: Path | None,
    log_file: Path | None,
) -> None:
    """Serve cells with the skills of libraries, by default of the project here.

    A cell has the skills of the library in whose folder its scene is, otherwise those of the first one.
    """
    require_server()
    if network.ros2:
        require_ros2("--ros2")
    with importing():
        from skillc.cli.console import Terminal
        from skillc.server.cells import choose_cells
        from skillc.server.log import logging_to
        from skillc.server.ros2_node import ros2_node
        from skillc.server.serve import serve
        from skillc.server.state import open_state

    listening = _make_listening(network)
    served = choose_cells(libraries or (Path(),), scenes, state, backend, seed)
    with logging_to(log_file), ros2_node() if network.ros2 else nullcontext() as start_node:
        serve(served, listening, open_state(state, token_file), Terminal(), start_node)


def _make_listening(network: NetworkOptions) -> Listening:
    from skillc.server.http.listening import Certificate, Listening

    cert, key = network.tls_cert, network.tls_key
    if (cert is None) != (key is None):
        raise click.UsageError("give both --tls-cert and --tls-key")
    certificate = Certificate(cert, key) if cert is not None and key is not None else None
    return Listening(*parse_address(network.bind), network.names, certificate, network.proxy)
