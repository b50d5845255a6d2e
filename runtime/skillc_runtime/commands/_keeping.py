"""The options that keep the world in a store; nothing heavy is imported here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

import click

Command = TypeVar("Command", bound=Callable[..., Any])


@dataclass(frozen=True, slots=True)
class Keeping:
    """Where a world is kept, a folder or the address of a SPARQL server, and whether it begins anew there.

    The address may have a password, so it is not shown; `name` is the place without it.
    """

    place: str | None = field(default=None, repr=False)
    reset: bool = False

    @property
    def name(self) -> str:
        """What the place is called in messages."""
        from skillc_runtime.store.address import without_credentials

        return without_credentials(self.place or "")


NOT_KEPT = Keeping()


def options(command: Command) -> Command:
    """Add `--store` and `--reset` to a command, which gets them as `store` and `reset`."""
    command = click.option("--reset", is_flag=True, help="Empty the store and fill it with the scene again.")(command)
    help_ = "Keep the world in a folder or on a SPARQL server; the first use fills it with the scene."
    return click.option("--store", metavar="FOLDER|URL", help=help_)(command)


def keeping(store: str | None, reset: bool) -> Keeping:
    """Return what the options say; UsageError for `--reset` alone."""
    if reset and store is None:
        raise click.UsageError("--reset empties a store; say which with --store")
    return Keeping(store, reset)
