"""A cell whose process dies at any moment loses no fact, makes none twice, and its history can be read."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections import Counter
from contextlib import closing
from pathlib import Path
from random import Random

from running_cells.yard import CRATES, find_settings, write_yard
from skillc.cells.host import open_cell
from skillc.cells.journal.reading import JournalReader
from skillc.services.reporting import SilentReporter
from skillc_runtime.recording.events import TaskEnded, WorldChanged
from skillc_runtime.store.disk import DiskStore
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.terms import CONTAIN

KILLS = int(os.environ.get("SKILLC_CELL_KILLS", "4"))
"""How often the process of a cell is killed."""


def start_carrier(folder: Path, operation: str, *limit: str) -> subprocess.Popen[str]:
    """Start the process of a cell; return it once the operation was submitted."""
    command = (sys.executable, "-m", "running_cells.carrier", str(folder), operation, *limit)
    paths = os.pathsep.join([str(Path(__file__).parents[1]), *filter(None, sys.path)])
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": paths})
    assert process.stdout is not None
    assert process.stdout.readline() == "started\n"
    return process


def test_a_killed_cell_loses_nothing_and_repeats_nothing(tmp_path: Path) -> None:
    chance, killed = Random(0), 0
    write_yard(tmp_path, takes_ms=40)
    for life in range(10 * KILLS):
        with start_carrier(tmp_path, f"op-{life}") as process:
            try:
                process.wait(chance.uniform(0.2, 0.8) if killed < KILLS else 60.0)
            except subprocess.TimeoutExpired:
                process.kill()
                killed += 1
        if process.returncode == 0:
            break
        check(tmp_path)
    assert killed > 0 and process.returncode == 0
    assert check(tmp_path)["lab:Goal"] == CRATES


def test_a_cell_whose_disk_is_full_stops_and_says_so(tmp_path: Path) -> None:
    write_yard(tmp_path, takes_ms=20)
    with start_carrier(tmp_path, "full", "120000") as process:
        assert process.stdout is not None
        said = process.stdout.read()
    assert "failed" in said and "journal.sqlite cannot be written (" in said
    brought = check(tmp_path)["lab:Goal"]
    assert brought < CRATES
    with start_carrier(tmp_path, "again") as process:
        process.wait(60.0)
    assert check(tmp_path)["lab:Goal"] == CRATES


def check(folder: Path) -> Counter[str]:
    """Check that journal, store and events tell one story; return how many crates were brought to each place."""
    journal = find_settings(folder).journal
    with open_cell(find_settings(folder), SilentReporter()) as host:
        world = host.world.snapshot()
    with closing(JournalReader(journal)) as reader:
        writes = [each.transaction for each in reader.writes()]
        histories = [[each.event for each in reader.envelopes(one.id)] for one in reader.latest(time.time_ns(), 1000)]
    assert histories and all(isinstance(each[-1], TaskEnded) for each in histories)
    assert [each.sequence for each in writes] == list(range(2, len(writes) + 2))
    with closing(DiskStore(journal.parent / "world")) as store:
        assert store.read().sequence == len(writes) + 1
    recorded = [
        change for each in histories for event in each if isinstance(event, WorldChanged) for change in event.changes
    ]
    assert len(recorded) == sum(len(each.changes) for each in writes)
    made = [change for each in writes for change in each.changes if isinstance(change, AddRelation)]
    brought = Counter(world.vocabulary.short(change.subject) for change in made)
    there = {world.vocabulary.short(each) for each in world.objects(world.vocabulary.expand("lab:Goal"), CONTAIN)}
    assert len(there) == brought["lab:Goal"], "no crate was lost, and none brought twice"
    return brought
