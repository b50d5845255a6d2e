"""What the commands share that run a server."""

from __future__ import annotations

from importlib.util import find_spec

import click

DEFAULT_BIND = "127.0.0.1:8421"


def require_server() -> None:
    """Raise UsageError if no server can run here."""
    if find_spec("uvicorn") is None:
        raise click.UsageError("the server needs uvicorn and starlette: pip install 'skillc[server]'")
    from skillc_runtime.platforms.processes import INHERITS_SOCKETS

    if not INHERITS_SOCKETS:
        raise click.UsageError("`skillc serve` needs Linux or macOS: processes of Windows inherit no sockets")


def parse_address(bind: str) -> tuple[str, int]:
    """Return host and port; UsageError if a text is no address."""
    host, _, port = bind.rpartition(":")
    if not host or not port.isdecimal() or int(port) > 65535:
        raise click.UsageError(f"--bind {bind}: write HOST:PORT, such as {DEFAULT_BIND}")
    return host.strip("[]"), int(port)
