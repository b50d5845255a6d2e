"""The option `--looks`: whose meshes films show."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from skillc_runtime.simulation.cell import SimulatedCell

PRIMITIVE = "primitive"

Command = TypeVar("Command", bound=Callable[..., Any])


def option(command: Command) -> Command:
    """Give a command the option `--looks`."""
    return click.option(
        "--looks",
        default=PRIMITIVE,
        show_default=True,
        metavar="NAME",
        help="What devices look like in films and stills: `primitive` shapes, or meshes of `menagerie`, fetched once.",
    )(command)


def check(looks: str, out: Path | None) -> None:
    """Refuse looks that nobody would see."""
    if looks != PRIMITIVE and out is None:
        raise click.UsageError(f"--looks {looks} is about films and stills; say with --out where they shall go")


def drawn(cell: SimulatedCell, looks: str) -> Any:
    """Return the model that is drawn for a cell, None for its own; exit with code 1 and the reason if there is none."""
    if looks == PRIMITIVE:
        return None
    from skillc_runtime.simulation.build import described
    from skillc_runtime.simulation.looks import LooksError, read_looks
    from skillc_runtime.simulation.looks_meshes import dressed

    try:
        wanted = read_looks(cell.world.snapshot(), cell.facts, looks)
        return dressed(described(cell.facts, cell.variation), wanted)
    except LooksError as error:
        click.echo(f"error: {error}", err=True)
        sys.exit(1)
