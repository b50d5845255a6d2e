"""Lets a cell of a state folder go on with the facts in its store."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

from skillc.cells.database import DatabaseError
from skillc.cells.evidence import keep_as_given
from skillc.cells.journal.fingerprint import Fingerprint, make_fingerprint
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import LATEST_WRITE, JournalReader
from skillc.cells.settings import JOURNAL, WORLD
from skillc.errors import RequestError, ServiceError
from skillc.server.state import CELLS
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.execution.cell_loop import NotDurable
from skillc_runtime.store.disk import DiskStore
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError
from skillc_runtime.world.state.world_state import WorldState


def adopt_world(folder: Path, who: str, why: str) -> int:
    """Let the cell in a folder, which does not run, go on with the facts in its store; return the number of that write.

    The facts count as given by a person from then on. The journal keeps what the cell did before, and gets a write that
    changes nothing and says who adopted the facts, and why.
    StoreError if the cell runs; StoreError, DatabaseError or NotDurable if something cannot be read or written.
    """
    origin, nowhere = f"{who}: {why}", WorldState.empty(Vocabulary())
    nothing = ChangeEvent((), origin, nowhere, nowhere, None)
    with (
        closing(DiskStore(folder / WORLD, owner="`skillc state adopt`")) as store,
        closing(CellJournal(folder / JOURNAL, store)) as journal,
        closing(JournalReader(folder / JOURNAL)) as reader,
    ):
        found = make_fingerprint(store.read())
        written = (each.transaction.sequence for each in reader.latest_writes(LATEST_WRITE, 1))
        last = max(found.sequence, next(written, 0))
        for sequence in range(found.sequence, last):
            store.append(nothing, sequence)
        journal.set_fingerprint(Fingerprint(last, found.digest))
        journal.append(nothing, last)
        keep_as_given(journal, last + 1, origin)
        journal.commit()
    return last + 1


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
