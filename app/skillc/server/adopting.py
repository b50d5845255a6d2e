"""Lets a cell of a state folder go on with the facts in its store."""

from __future__ import annotations

from pathlib import Path

from skillc.cells.adopting import adopt_world
from skillc.cells.database import DatabaseError
from skillc.errors import RequestError, ServiceError
from skillc.server.state import CELLS
from skillc_runtime.execution.cell_loop import NotDurable
from skillc_runtime.world.state.transactions import StoreError


def adopt(state: Path, cell: str, who: str, why: str) -> None:
    """Take the facts in the store of a cell as its world; `who` says so, and `why` it is right.

    RequestError if there is no such cell; ServiceError if it runs, or something cannot be read or written.
    """
    cells = sorted(each.name for each in (state / CELLS).glob("*"))
    if cell not in cells:
        raise RequestError(f"{state} has no cell {cell}; it has {', '.join(cells) or 'none'}")
    try:
        adopt_world(state / CELLS / cell, who, why)
    except (DatabaseError, NotDurable, StoreError) as error:
        raise ServiceError(str(error)) from error
