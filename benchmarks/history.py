"""Compares how long a cell takes to start, and to list and find operations, after a few and after many operations.

A cell without physics; each operation has two writes to the world and four events.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from statistics import median

from skillc.cells.host import CellHost
from skillc.cells.journal.reading import JournalReader
from skillc.cells.opening import open_cell
from skillc.cells.settings import CellSettings
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc.services.library.files import find_scene
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import Note
from skillc_runtime.world.state.changes import SetProperty

COUNTS = (1_000, 10_000, 100_000)
BATCH, REPEATS = 500, 5
SURFACE = "lab:Table-1"


def add_operations(host: CellHost, first: int, count: int) -> None:
    """Add operations that have ended to the history of a cell."""
    vocabulary = host.world.snapshot().vocabulary
    surface, clean = vocabulary.expand(SURFACE), vocabulary.expand("wiping:isClean")
    request = OperationRequest(task="clean_table")
    for number in range(first, first + count):
        name = f"operation-{number}"
        host._journal.add_operation(name, request, number + 1)
        for value in (True, False):
            host.world.commit([SetProperty(surface, clean, value)], "Inspect", "sensed")
        for sequence in range(1, 5):
            event = Note(time=float(number), message="it was looked at")
            host._journal.record(Envelope(run=name, sequence=sequence, wall_time_ns=number, event=event))
        host._journal.end_operation(OperationStatus(id=name, cell="cell", request=request, state="succeeded", events=4))
        if number % BATCH == 0:
            host._commit()
    host._commit()


def measure(work: Callable[[], object]) -> float:
    """Return the median time of some work in s."""
    times = []
    for _ in range(REPEATS):
        began = time.perf_counter()
        work()
        times.append(time.perf_counter() - began)
    return median(times)


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        settings = CellSettings(
            name="cell",
            scene=str(find_scene(Path("iiwa_table.ttl"))),
            library="wiping",
            folder=folder,
            backend="kinematic",
        )

        def start() -> None:
            with open_cell(settings, SilentReporter()):
                pass

        rows, before = [("new", measure(start), 0.0, 0.0, 0.0)], 0
        for count in COUNTS:
            with open_cell(settings, SilentReporter()) as host:
                add_operations(host, before, count - before)
            before = count
            with closing(JournalReader(settings.journal)) as reader:
                listed = measure(lambda reader=reader: reader.latest(time.time_ns(), 100))
                found = measure(lambda reader=reader: reader.find("operation-7"))
            size = settings.journal.stat().st_size / count
            rows.append((f"{count}", measure(start), listed, found, size))
    print("operations  start, ratio to a new cell  list 100, ratio  find one, ratio  bytes each")
    first, few = rows[0][1], rows[1]
    for name, started, listed, found, size in rows:
        ratios = (started / first, listed / few[2], found / few[3])
        print(f"{name:>10}  {started:6.2f} s  {ratios[0]:14.2f}  {ratios[1]:15.2f}  {ratios[2]:15.2f}  {size:10.0f}")


if __name__ == "__main__":
    main()
