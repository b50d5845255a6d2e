"""Killed at any moment, a writer loses nothing that it was told is kept and leaves nothing half done."""

import os
import time
from pathlib import Path
from random import Random

import pytest

from skillc_runtime.store.disk import DiskStore
from skillc_runtime.world.state.transactions import Transaction
from skillc_runtime.world.state.world_state import WorldState
from store.actors import write, write_and_tidy_up
from store.processes import Actor
from store.worlds import facts_of, model_of
from world.lab import SCENE, iri

KILLS = int(os.environ.get("SKILLC_STORE_KILLS", "1"))
"""How often the moments are chosen anew; 60 make more than 6,000 writes."""


def replayed(transactions: tuple[Transaction, ...]) -> WorldState:
    state = SCENE
    for each in transactions:
        state = state.with_changes(each.changes)
    return state


@pytest.mark.parametrize("seed", range(KILLS))
def test_a_killed_writer_loses_nothing(tmp_path: Path, seed: int) -> None:
    place, chance, acknowledged = tmp_path / "store", Random(seed), list[str]()
    keeper = DiskStore(place)
    model_of(keeper)
    for life in range(3):
        writer = Actor(write, str(place), seed, 100_000, f"life-{life}")
        acknowledged += [writer.hear() for _ in range(chance.randint(10, 60))]
        time.sleep(chance.random() * 0.02)
        writer.kill()
        acknowledged += writer.told()
    kept = keeper.since(1)
    assert [each.sequence for each in kept] == list(range(2, len(kept) + 2))
    origins = [each.origin for each in kept]
    assert len(acknowledged) >= 30
    assert [o for o in origins if o in set(acknowledged)] == acknowledged
    surplus = [origin for origin in origins if origin not in set(acknowledged)]
    assert len(surplus) <= 3, "at most the write that each life died in"
    assert facts_of(model_of(keeper).snapshot()) == facts_of(replayed(kept))
    keeper.close()
    assert facts_of(model_of(DiskStore(place)).snapshot()) == facts_of(replayed(kept))


@pytest.mark.parametrize("seed", range(KILLS))
def test_whoever_is_killed_while_tidying_up_loses_nothing(tmp_path: Path, seed: int) -> None:
    writer = Actor(write_and_tidy_up, tmp_path / "store")
    writer.hear()
    time.sleep(Random(seed).random() * 0.6)
    writer.kill()
    acknowledged = 1 + len(writer.told())
    kept = DiskStore(tmp_path / "store").read()
    assert kept.sequence - 1 in (acknowledged, acknowledged + 1)
    model = model_of(DiskStore(tmp_path / "store"))
    assert model.snapshot().value(iri("box"), iri("weight")) == float(kept.sequence - 1)
