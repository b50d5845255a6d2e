"""While a store has an owner, nobody else writes to it; everybody may read, and a dead owner owns nothing."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

import pytest

from skillc_runtime.store.disk import DiskStore
from skillc_runtime.world.state.transactions import StoreError
from store.actors import own_and_write
from store.processes import Actor
from store.worlds import model_of
from world.lab import assign, iri

REFUSED = r"store belongs to the cell lab \(process (\d+)\), and nobody else may write to it: .*`skillc start`"


def weight(store: DiskStore) -> object:
    return model_of(store).snapshot().value(iri("box"), iri("weight"))


def test_others_read_and_do_not_write_until_the_owner_is_gone(tmp_path: Path) -> None:
    with closing(DiskStore(tmp_path / "store")) as before:
        guest = model_of(before)
        owner = Actor(own_and_write, tmp_path / "store")
        assert owner.hear() == "5.0"
        guest.follow()
        assert guest.snapshot().value(iri("box"), iri("weight")) == 5.0
        with pytest.raises(StoreError, match=REFUSED) as refused:
            guest.commit([assign("box", "weight", 6.0)])
        assert f"(process {owner.process.pid})" in str(refused.value)
        with pytest.raises(StoreError, match=REFUSED):
            before.require_writable()
        with closing(DiskStore(tmp_path / "store")) as other:
            assert weight(other) == 5.0
            with pytest.raises(StoreError, match=REFUSED):
                model_of(other).commit([assign("box", "weight", 6.0)])
        with pytest.raises(StoreError, match="cannot be reset while process"):
            DiskStore(tmp_path / "store", reset=True)
        owner.kill()
        owner.told()
        guest.commit([assign("box", "weight", 6.0)])
        before.require_writable()
    with closing(DiskStore(tmp_path / "store")) as after:
        assert weight(after) == 6.0


def test_an_empty_store_is_filled_by_its_owner_alone(tmp_path: Path) -> None:
    with closing(DiskStore(tmp_path / "store", owner="the cell lab")) as store:
        with closing(DiskStore(tmp_path / "store")) as other, pytest.raises(StoreError, match=REFUSED):
            model_of(other)
        assert weight(store) == weight(store)
    with closing(DiskStore(tmp_path / "store")) as later:
        assert model_of(later).commit([assign("box", "weight", 6.0)])


def test_a_store_has_one_owner(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("skillc_runtime.store.owner.PATIENCE_S", 0.05)
    with closing(DiskStore(tmp_path / "store", owner="the cell lab")):
        for _ in range(2):
            with pytest.raises(StoreError, match=REFUSED):
                DiskStore(tmp_path / "store", owner="the cell other")
    DiskStore(tmp_path / "store", owner="the cell other").close()
