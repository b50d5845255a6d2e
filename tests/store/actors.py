"""What processes do to a store in the tests; each tells, while it goes on, what it was told is kept."""

from __future__ import annotations

import itertools
import os
import resource
import signal
from multiprocessing.connection import Connection
from multiprocessing.synchronize import Barrier
from pathlib import Path
from random import Random

from skillc.services.scene.stores import open_store
from skillc_runtime.store.disk import JOURNAL, DiskStore
from skillc_runtime.store.world_from_triples import build_world
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.transactions import StoreError
from store.worlds import facts_of, model_of, random_write
from waiting import LONG_S
from world.lab import VOCABULARY, assign

TOGETHER = 10
"""After so many writes each process waits for the others, so that none writes all before they begin."""


def write(tell: Connection, place: str, seed: int, count: int, name: str, begin: Barrier | None = None) -> None:
    """Make so many random writes, whatever others do; tell the origin of each. Each `TOGETHER` begin at once."""
    store = open_store(place)
    kept = store.read()
    model = WorldModel(build_world(kept.triples, VOCABULARY, place), store, kept.sequence)
    chance = Random(seed)
    for number in range(count):
        if begin and number % TOGETHER == 0:
            begin.wait(timeout=LONG_S)
        _write_one(model, chance, f"{name} {number}")
        tell.send(f"{name} {number}")


def _write_one(model: WorldModel, chance: Random, origin: str) -> None:
    while True:
        try:
            model.commit(random_write(chance), origin)
        except WorldError:
            continue
        return


def own_and_write(tell: Connection, place: Path) -> None:
    """Own a store, write to it, and go on owning it; tell what was written."""
    store = DiskStore(place, owner="the cell lab")
    model_of(store).commit([assign("box", "weight", 5.0)])
    tell.send("5.0")
    signal.pause()


def write_and_tidy_up(tell: Connection, place: Path) -> None:
    """Open, write and close, which tidies up, without end; tell the number of each write."""
    for number in itertools.count(1):
        store = DiskStore(place)
        model_of(store).commit([assign("box", "weight", float(number))])
        tell.send(str(number))
        store.close()


def write_to_a_full_disk(tell: Connection, place: Path) -> None:
    """Write until the disk is full, which a limit on file sizes stands for; tell how often and why it ended."""
    model = model_of(DiskStore(place))
    for number in range(9):
        model.commit([assign("box", "weight", float(number))])
    endless = resource.RLIM_INFINITY
    resource.setrlimit(resource.RLIMIT_FSIZE, ((place / JOURNAL).stat().st_size + 1200, endless))
    before, made = model.snapshot(), 0
    try:
        while True:
            before = model.commit([assign("box", "weight", 100.0 + made)]).after
            made += 1
    except StoreError as error:
        assert model.snapshot() is before
        tell.send(str(made))
        tell.send(str(error))
    resource.setrlimit(resource.RLIMIT_FSIZE, (endless, endless))
    model.commit([assign("box", "weight", 1000.0)])


def use_as_a_guest(tell: Connection, folder: Path, name: str) -> None:
    """Use a store in a folder as somebody who may only read; tell the size of its world and the two refusals."""
    os.chdir(folder)
    if os.geteuid() == 0:
        os.setuid(65534)
    model = model_of(DiskStore(Path(name)))
    tell.send(str(len(facts_of(model.snapshot()))))
    try:
        model.commit([assign("box", "weight", 5.0)])
    except StoreError as error:
        tell.send(str(error))
    try:
        DiskStore(Path(name) / "new")
    except StoreError as error:
        tell.send(str(error))


def fill_a_full_disk(tell: Connection, place: Path) -> None:
    """Fill a store on a disk without room, which a limit on file sizes stands for; tell what is said of it."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, resource.RLIM_INFINITY))
    try:
        model_of(DiskStore(place))
    except StoreError as error:
        tell.send(str(error))
