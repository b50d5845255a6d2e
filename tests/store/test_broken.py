"""Folders that are no stores, damaged stores, full and read-only disks: a clear word, and nothing lost."""

import os
import shutil
from pathlib import Path

import pyoxigraph as ox
import pytest

from skillc.services.scene.stores import open_store
from skillc_runtime.store import facts_folder
from skillc_runtime.store.disk import FACTS, FORMAT, JOURNAL, MARK, DiskStore
from skillc_runtime.store.journal import LAST
from skillc_runtime.world.state.transactions import StoreError
from store.actors import use_as_a_guest, write_to_a_full_disk
from store.processes import Actor
from store.worlds import facts_of, model_of
from world.lab import assign, iri


def written(place: Path, writes: int = 3) -> Path:
    """Return the folder of a store with some writes in its journal, as a process that died leaves it."""
    original = place.with_name("original")
    store = DiskStore(original)
    model = model_of(store)
    for number in range(writes):
        model.commit([assign("box", "weight", float(number))])
    shutil.copytree(original, place)
    store.close()
    return place


def weight(place: Path) -> object:
    return model_of(DiskStore(place)).snapshot().value(iri("box"), iri("weight"))


def test_a_folder_of_other_things_is_no_store(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").touch()
    with pytest.raises(StoreError, match=r"is not a store: it holds thesis.tex; name a new or an empty folder"):
        DiskStore(tmp_path)
    assert sorted(each.name for each in tmp_path.iterdir()) == ["thesis.tex"]


def test_a_file_is_no_store(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(StoreError, match=r"is a file; a store is a folder"):
        DiskStore(tmp_path / "file")
    with pytest.raises(StoreError, match=r"cannot be opened"):
        DiskStore(tmp_path / "file" / "below")


def test_a_store_of_another_version_is_named(tmp_path: Path) -> None:
    place = written(tmp_path / "store")
    (place / MARK).write_text("skillc store, format 9\n", encoding="utf-8")
    with pytest.raises(StoreError, match=r"format 9.*this skillc reads.*format 1"):
        DiskStore(place)
    assert FORMAT.startswith("skillc store")


@pytest.mark.slow
def test_the_line_that_a_writer_died_in_does_not_count(tmp_path: Path) -> None:
    journal = (written(tmp_path / "whole") / JOURNAL).read_bytes()
    shutil.rmtree(tmp_path / "original")
    ends = [at + 1 for at, byte in enumerate(journal) if byte == ord("\n")]
    assert len(ends) == 3 and ends[-1] == len(journal)
    cuts = {0, 1, *(end + near for end in ends for near in (-1, 0)), ends[1] + 9}
    for length in sorted(cuts):
        place = tmp_path / f"cut-{length}"
        shutil.copytree(tmp_path / "whole", place)
        (place / LAST).unlink()
        (place / JOURNAL).write_bytes(journal[:length])
        complete = sum(end <= length for end in ends)
        assert weight(place) == (float(complete - 1) if complete else 3.0)


def test_after_a_broken_line_writing_goes_on(tmp_path: Path) -> None:
    place = written(tmp_path / "store")
    holder = DiskStore(tmp_path / "original")
    os.truncate(place / JOURNAL, (place / JOURNAL).stat().st_size - 5)
    (place / LAST).unlink()
    store = DiskStore(place)
    model = model_of(store)
    model.commit([assign("box", "weight", 9.0)])
    assert weight(place) == 9.0
    holder.close()


@pytest.mark.parametrize("line", [0, 1, 2])
def test_a_damaged_line_is_told_with_what_is_whole(tmp_path: Path, line: int) -> None:
    place = written(tmp_path / "store")
    lines = (place / JOURNAL).read_bytes().splitlines(keepends=True)
    damaged = lines[line].replace(b"box", b"bix", 1)
    assert damaged != lines[line]
    (place / JOURNAL).write_bytes(b"".join([*lines[:line], damaged, *lines[line + 1 :]]))
    offset = sum(map(len, lines[:line]))
    words = f"is damaged from byte {offset} on, after transaction {line + 1}; .* shorten the file to {offset} bytes"
    with pytest.raises(StoreError, match=words):
        model_of(DiskStore(place))
    os.truncate(place / JOURNAL, offset)
    (place / LAST).unlink()
    assert weight(place) == (float(line - 1) if line else 3.0)


def test_damaged_facts_are_told_and_can_be_filled_anew(tmp_path: Path) -> None:
    place = written(tmp_path / "store")
    for file in (place / FACTS).glob("MANIFEST*"):
        file.write_bytes(b"nonsense" * 100)
    store = DiskStore(place)
    with pytest.raises(StoreError, match=r"facts are damaged.*fill the store again with --reset") as caught:
        model_of(store)
    assert "\n" not in str(caught.value)
    store.close()
    assert model_of(DiskStore(place, reset=True)).snapshot().value(iri("box"), iri("weight")) == 3.0


def test_facts_that_say_nothing_of_themselves_are_damaged(tmp_path: Path) -> None:
    ox.Store(str(tmp_path / "facts")).flush()
    with pytest.raises(StoreError, match=r"sequence> is missing"):
        facts_folder.read(tmp_path / "facts")


def test_a_store_in_use_is_not_reset(tmp_path: Path) -> None:
    user = DiskStore(tmp_path / "store")
    model = model_of(user)
    with pytest.raises(StoreError, match=r"cannot be reset while .* uses it"):
        DiskStore(tmp_path / "store", reset=True)
    model.commit([assign("box", "weight", 7.0)])
    user.close()
    assert weight(tmp_path / "store") == 7.0


def test_a_full_disk_refuses_the_write_and_loses_none(tmp_path: Path) -> None:
    writer = Actor(write_to_a_full_disk, tmp_path / "store")
    made, message = writer.told()
    assert writer.process.exitcode == 0
    assert int(made) > 0 and "nothing can be written to" in message and "File too large" in message
    kept = model_of(DiskStore(tmp_path / "store"))
    assert kept.snapshot().value(iri("box"), iri("weight")) == 1000.0
    assert DiskStore(tmp_path / "store").read().sequence == 1 + 9 + int(made) + 1


def test_a_store_that_may_only_be_read_is_read(tmp_path: Path) -> None:
    place = written(tmp_path / "store")
    expected = len(facts_of(model_of(DiskStore(place)).snapshot()))
    for file in place.rglob("*"):
        file.chmod(0o555 if file.is_dir() else 0o444)
    place.chmod(0o555)
    tmp_path.chmod(0o755)
    guest = Actor(use_as_a_guest, tmp_path, place.name)
    count, refused, closed = guest.told()
    place.chmod(0o755)
    assert guest.process.exitcode == 0 and int(count) == expected
    assert refused.endswith("journal is read-only here, so nothing can be written to the store")
    assert closed.endswith("cannot be opened: Permission denied")


@pytest.mark.parametrize("address", ["ftp://host/x", "http://", "http:///path", "urn://x"])
def test_an_address_of_no_server_is_told(address: str) -> None:
    with pytest.raises(StoreError, match=r"is not an address of a SPARQL server"):
        open_store(address)


def test_a_store_that_takes_nothing_though_nobody_wrote_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    model = model_of(DiskStore(tmp_path / "store"))
    monkeypatch.setattr(DiskStore, "append", lambda store, event, sequence: False)
    before = model.snapshot()
    with pytest.raises(StoreError, match=r"store rejects a write, although no other process has written"):
        model.commit([assign("box", "weight", 4.0)])
    assert model.snapshot() is before
