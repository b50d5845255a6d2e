"""No wait for a server, another process or another thread is endless, and each can be cancelled."""

from __future__ import annotations

import fcntl
import socket
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.store.disk import JOURNAL, DiskStore
from skillc_runtime.store.http import HttpEndpoint, ServerUnreachable
from skillc_runtime.store.sparql import SparqlStore
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError, Transaction
from store.memory import MemoryStore
from store.worlds import filling, model_of
from waiting import LONG_S
from world.lab import SCENE, assign


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return the folder of a store whose journal another user holds locked."""
    model_of(store := DiskStore(tmp_path / "store"))
    store.close()
    return tmp_path / "store"


def test_a_journal_that_stays_locked_is_an_error_that_says_so(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    model = model_of(DiskStore(folder))
    monkeypatch.setattr("skillc_runtime.store.journal.PATIENCE_S", 0.05)
    with (folder / JOURNAL).open() as other:
        fcntl.flock(other, fcntl.LOCK_EX)
        with pytest.raises(StoreError, match=r"journal is locked by .*; try again later"):
            model.commit([assign("box", "weight", 8.0)])
    model.commit([assign("box", "weight", 9.0)])


def test_the_wait_for_a_lock_can_be_cancelled(folder: Path) -> None:
    cancel = CancelToken()
    model = model_of(DiskStore(folder, cancel=cancel))
    with (folder / JOURNAL).open() as other:
        fcntl.flock(other, fcntl.LOCK_EX)
        threading.Timer(0.1, cancel.cancel, ("it was stopped",)).start()
        with pytest.raises(StoreError, match="locked by"):
            model.commit([assign("box", "weight", 8.0)])


def test_the_wait_for_a_server_can_be_cancelled() -> None:
    with socket.socket() as unused:
        unused.bind(("127.0.0.1", 0))
        cancel = CancelToken()
        endpoint = HttpEndpoint(f"http://127.0.0.1:{unused.getsockname()[1]}", "/query", "/update", cancel=cancel)
        cancel.cancel("it was stopped")
        with pytest.raises(ServerUnreachable):
            SparqlStore(endpoint, patience_s=1e6, cancel=cancel)


@pytest.fixture
def transaction_elsewhere() -> Iterator[WorldModel]:
    """Return a world in which another thread has a transaction open."""
    model, opened, end = WorldModel(SCENE), threading.Event(), threading.Event()

    def hold() -> None:
        with model.transaction():
            opened.set()
            end.wait(LONG_S)

    other = threading.Thread(target=hold)
    other.start()
    opened.wait(LONG_S)
    yield model
    end.set()
    other.join(LONG_S)


def test_a_transaction_that_does_not_end_is_an_error_of_the_next_write(
    transaction_elsewhere: WorldModel, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("skillc_runtime.world.state.model.LOCK_S", 0.05)
    with pytest.raises(WorldError, match=r"another thread has a transaction open for more than 0\.05 s"):
        transaction_elsewhere.commit([assign("box", "weight", 8.0)])


class Busy(MemoryStore):
    """A store to which somebody else writes before every write."""

    def append(self, event: ChangeEvent, after: int) -> bool:
        self.written.append(Transaction(len(self.written) + 1, "somebody", (assign("box", "weight", 1.0),)))
        return super().append(event, after)


def test_a_store_that_others_write_to_all_the_time_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("skillc_runtime.world.state.model.MAX_ATTEMPTS", 5)
    store = Busy()
    MemoryStore.append(store, filling(), 0)
    model = WorldModel(SCENE, store, 1)
    with pytest.raises(StoreError, match="other processes write to it all the time"):
        model.commit([assign("box", "weight", 8.0)])
    assert len(store.written) == 6
