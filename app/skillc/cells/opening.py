"""Starts a cell where it ended."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from skillc.cells.host import CellHost
from skillc.cells.journal.fingerprint import make_fingerprint
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalReader
from skillc.cells.library import load_library
from skillc.cells.operations.interrupted import end_interrupted
from skillc.cells.settings import WORLD, CellSettings
from skillc.cells.world import restore_world
from skillc.services.library.files import find_scene
from skillc.services.reporting.reporter import Reporter
from skillc.services.scene.stores import StoreChoice, read_or_fill
from skillc_runtime.store.disk import DiskStore


@contextmanager
def open_cell(settings: CellSettings, reporter: Reporter) -> Iterator[CellHost]:
    """Start a cell where it ended: its world is that of its journal, and operations that had no end are interrupted.

    ServiceError, StoreError, DatabaseError, NotDurable, SheetError or FrameError if that is not possible.
    """
    library, scene = load_library(settings), find_scene(Path(settings.scene))
    folder = Path(settings.folder)
    folder.mkdir(parents=True, exist_ok=True)
    choice = StoreChoice(str(folder / WORLD))
    with closing(DiskStore(folder / WORLD, owner=f"the cell {settings.name}")) as store:
        state, _ = read_or_fill(store, choice, scene, library.vocabulary, reporter)
        found = make_fingerprint(store.read())
        with (
            closing(CellJournal(settings.journal, store)) as journal,
            closing(JournalReader(settings.journal)) as reader,
        ):
            world = restore_world(store, state, found, journal, reader)
            end_interrupted(settings.name, reader, journal, settings.ended)
            host = CellHost(settings, library, world, journal, reader, scene, reporter)
            try:
                yield host
            finally:
                host.close("the cell ends")
