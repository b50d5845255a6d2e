"""What the commands share that run a server."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import Any, TypeVar

import click

from skillc.cli.options import BACKEND, FOLDER, PATH
from skillc.extras import install_command, require

DEFAULT_BIND = "127.0.0.1:8421"
Function = TypeVar("Function", bound=Callable[..., Any])


def cell_options(function: Function) -> Function:
    """Add `--cell`, as `scenes`, `--state`, `--backend` and `--seed`: which cells a server has, and how."""
    options = (
        click.option(
            "--cell",
            "scenes",
            type=PATH,
            multiple=True,
            help="A scene to run as a cell, here or in the folder of the LIBRARY. Can be repeated.",
        ),
        click.option(
            "--state", type=FOLDER, default=Path(".skillc"), show_default=True, help="Keep the state in this folder."
        ),
        click.option(
            "--backend",
            type=BACKEND,
            default="mujoco",
            show_default=True,
            help="Run cells of this backend: `mujoco` has physics, `kinematic` ideal contact, `symbolic` facts alone; "
            "packages add others.",
        ),
        click.option(
            "--seed", default=0, show_default=True, help="Seed of the differences between world model and simulation."
        ),
    )
    for option in reversed(options):
        function = option(function)
    return function


def require_server() -> None:
    """Raise MissingExtraError or UsageError if no server can run here."""
    require("a server", "server", "run")
    from skillc_runtime.platforms.processes import INHERITS_SOCKETS

    if not INHERITS_SOCKETS:
        raise click.UsageError("`skillc serve` needs Linux or macOS: processes of Windows inherit no sockets")


def require_ros2(what: str) -> None:
    """Raise UsageError if there is no ROS 2, neither a sourced one nor its wheels; `what` is what needs it."""
    if find_spec("rclpy") is None:
        raise click.UsageError(
            f"{what} needs ROS 2: source the set-up file of an installed one in this terminal, with the Python that it "
            f"was built for, or install its wheels (Linux on x86-64): {install_command('ros2')}"
        )


def parse_address(bind: str) -> tuple[str, int]:
    """Return host and port; UsageError if a text is no address."""
    host, _, port = bind.rpartition(":")
    if not host or not port.isdecimal() or len(port) > 5 or int(port) > 65535:
        raise click.UsageError(f"--bind {bind}: write HOST:PORT, such as {DEFAULT_BIND}")
    return host.strip("[]"), int(port)
