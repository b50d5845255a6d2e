"""Checks what a cell of a yard has kept, after a crash for example."""

from __future__ import annotations

from collections import Counter
from contextlib import closing

from skillc.cells.journal.reading import LATEST_NS, JournalReader
from skillc.cells.opening import open_cell
from skillc.cells.settings import CellSettings
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.recording.events import TaskEnded, WorldChanged
from skillc_runtime.store.disk import DiskStore
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.terms import CONTAIN


def check_cell(settings: CellSettings) -> Counter[str]:
    """Check that journal, store and events tell one story; return how many crates were brought to each place."""
    journal = settings.journal
    with open_cell(settings, SilentReporter()) as host:
        world = host.world.snapshot()
    with closing(JournalReader(journal)) as reader:
        writes = [each.transaction for each in reader.writes()]
        histories = [[each.event for each in reader.envelopes(one.id)] for one in reader.latest(LATEST_NS, 1000)]
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
