"""Several processes on one store: each sees what all the others wrote, in one order."""

from itertools import pairwise
from pathlib import Path

from skillc_runtime.world.store.disk import DiskStore
from store.processes import told, writer
from store.worlds import facts_of, model_of

WRITERS, WRITES = 3, 60


def test_processes_that_write_at_once_agree_on_one_order(tmp_path: Path) -> None:
    store = DiskStore(tmp_path / "store")
    model = model_of(store)
    processes = [writer(tmp_path / "store", seed, WRITES, f"writer-{seed}") for seed in range(WRITERS)]
    heard: list[str] = []
    model.listen(lambda event: heard.append(event.origin))
    while any(process.poll() is None for process in processes):
        model.follow()
    model.follow()
    lines = [told(process) for process in processes]
    assert all(process.returncode == 0 for process in processes)
    assert len(heard) == WRITERS * WRITES
    for own in lines:
        assert [origin for origin in heard if origin in set(own)] == own[:-1]
    changes = sum(one.split()[0] != next_.split()[0] for one, next_ in pairwise(heard))
    assert changes > WRITERS, "the writers took turns"
    store.close()
    again = model_of(DiskStore(tmp_path / "store"))
    assert facts_of(again.snapshot()) == facts_of(model.snapshot())
