"""Killed at any moment, a writer loses nothing that it was told is kept and leaves nothing half done."""

import itertools
import os
import signal
import time
from pathlib import Path
from random import Random
from typing import NoReturn

import pytest

from skillc_runtime.world.state import WorldState
from skillc_runtime.world.store.disk import DiskStore
from skillc_runtime.world.store.store import Transaction
from store.processes import told, writer
from store.worlds import facts_of, model_of
from world.lab import SCENE, assign, iri

KILLS = int(os.environ.get("SKILLC_STORE_KILLS", "2"))


def replayed(transactions: tuple[Transaction, ...]) -> WorldState:
    state = SCENE
    for each in transactions:
        state = state.changed(each.changes)
    return state


@pytest.mark.parametrize("seed", range(KILLS))
def test_a_killed_writer_loses_nothing(tmp_path: Path, seed: int) -> None:
    place, chance, acknowledged = tmp_path / "store", Random(seed), list[str]()
    keeper = DiskStore(place)
    model_of(keeper)
    for life in range(3):
        process = writer(place, seed, 100_000, f"life-{life}")
        assert process.stdout is not None
        acknowledged.append(process.stdout.readline().strip())
        time.sleep(chance.random() * 0.5)
        process.kill()
        acknowledged += told(process)
    kept = keeper.since(1)
    assert [each.sequence for each in kept] == list(range(2, len(kept) + 2))
    origins = [each.origin for each in kept]
    assert len(acknowledged) > 30
    assert [o for o in origins if o in set(acknowledged)] == acknowledged
    surplus = [origin for origin in origins if origin not in set(acknowledged)]
    assert len(surplus) <= 3, "at most the write that each life died in"
    assert facts_of(model_of(keeper).snapshot()) == facts_of(replayed(kept))
    keeper.close()
    assert facts_of(model_of(DiskStore(place)).snapshot()) == facts_of(replayed(kept))


@pytest.mark.parametrize("seed", range(KILLS))
def test_whoever_is_killed_while_tidying_up_loses_nothing(tmp_path: Path, seed: int) -> None:
    store = DiskStore(tmp_path / "store")
    model_of(store)
    store.close()
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        _write_and_tidy_up(tmp_path / "store", writing)
    os.close(writing)
    os.read(reading, 1)
    time.sleep(Random(seed).random() * 0.6)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    acknowledged = 1 + len(os.read(reading, 10_000))
    os.close(reading)
    kept = DiskStore(tmp_path / "store").read()
    assert kept.sequence - 1 in (acknowledged, acknowledged + 1)
    model = model_of(DiskStore(tmp_path / "store"))
    assert model.snapshot().value(iri("box"), iri("weight")) == float(kept.sequence - 1)


def _write_and_tidy_up(place: Path, acknowledge: int) -> NoReturn:
    """Open, write and close, which tidies up, again and again."""
    for number in itertools.count(1):
        store = DiskStore(place)
        model_of(store).commit([assign("box", "weight", float(number))])
        os.write(acknowledge, b".")
        store.close()
    raise AssertionError
