"""Several processes on one store: each sees what all the others wrote, in one order."""

from itertools import pairwise
from pathlib import Path

from skillc_runtime.store.disk import DiskStore
from store.actors import TOGETHER, write
from store.processes import PROCESSES, Actor
from store.worlds import facts_of, model_of

WRITERS, WRITES = 3, 60


def test_processes_that_write_at_once_agree_on_one_order(tmp_path: Path) -> None:
    store = DiskStore(tmp_path / "store")
    model = model_of(store)
    place, begin = str(tmp_path / "store"), PROCESSES.Barrier(WRITERS)
    writers = [Actor(write, place, seed, WRITES, f"writer-{seed}", begin) for seed in range(WRITERS)]
    heard: list[str] = []
    model.subscribe(lambda event: heard.append(event.origin))
    while any(writer.process.is_alive() for writer in writers):
        model.follow()
    model.follow()
    told = [writer.told() for writer in writers]
    assert all(writer.process.exitcode == 0 for writer in writers)
    assert len(heard) == WRITERS * WRITES
    for own in told:
        assert [origin for origin in heard if origin in set(own)] == own
    changes = sum(one.split()[0] != next_.split()[0] for one, next_ in pairwise(heard))
    assert changes > WRITES / TOGETHER, "the writers took turns"
    store.close()
    again = model_of(DiskStore(tmp_path / "store"))
    assert facts_of(again.snapshot()) == facts_of(model.snapshot())
