"""The journal of a cell keeps what was committed, and the world and its evidence are those of its last process."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from itertools import product
from pathlib import Path
from random import Random
from typing import TypeVar

import pytest

from skillc.cells.database import DatabaseError
from skillc.cells.evidence import EvidenceKeeper, read_merged
from skillc.cells.journal.fingerprint import FINGERPRINT, make_fingerprint
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalReader
from skillc.cells.journal.schema import SCHEMA
from skillc.cells.world import restore_world
from skillc.contract.operation import OperationRequest
from skillc.server.adopting import adopt_world
from skillc_runtime.execution.cell_loop import NotDurable
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import Note
from skillc_runtime.store.disk import DiskStore
from skillc_runtime.world.state.evidence import describe_evidence
from skillc_runtime.world.state.facts import Evidence, Fact, PropertyFact, RelationFact
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent, NullStore, StoreError
from store.worlds import PLACES, THINGS, facts_of, model_of, random_write
from world.lab import assign, iri

EVIDENCE: tuple[Evidence | None, ...] = ("sensed", "reported", "assumed", None)


def note(number: int) -> Envelope:
    return Envelope(run="op", sequence=number, wall_time_ns=number, event=Note(time=0.0, message=f"note {number}"))


@contextmanager
def reading(path: Path) -> Iterator[JournalReader]:
    with closing(JournalReader(path)) as reader:
        yield reader


def test_only_what_is_committed_is_kept(tmp_path: Path) -> None:
    path = tmp_path / "journal.sqlite"
    with closing(CellJournal(path, NullStore())) as journal:
        journal.add_operation("op", OperationRequest(task="tidy"), 1)
        for number in (1, 2, 3):
            journal.record(note(number))
        journal.commit()
        journal.record(note(4))
        with reading(path) as reader:
            assert reader.envelopes("op", after=1, limit=1) == (note(2),)
            assert reader.envelopes("op", after=2) == (note(3),) and reader.envelopes("other") == ()
    with reading(path) as reader:
        assert [(each.id, each.request.task) for each in reader.unfinished()] == [("op", "tidy")]
        assert reader.envelopes("op") == (note(1), note(2), note(3))


class BrokenStore(DiskStore):
    """A store on a disk that fails when it is told to."""

    fails = False

    def append(self, event: ChangeEvent, after: int) -> bool:
        if self.fails:
            raise StoreError("the disk is gone")
        return super().append(event, after)


@pytest.mark.parametrize("seed", range(3))
def test_a_store_that_missed_a_write_gets_it(tmp_path: Path, seed: int) -> None:
    chance = Random(seed)
    with opened(tmp_path, BrokenStore) as (world, journal, store):
        for _ in range(chance.randint(0, 19)):
            write(world, chance)
            journal.commit()
        store.fails = True
        write(world, chance)
        with pytest.raises(NotDurable, match="the disk is gone"):
            journal.commit()
    with opened(tmp_path, DiskStore) as (again, _, kept):
        assert facts_of(again.snapshot()) == facts_of(world.snapshot()) == facts_of(model_of(kept).snapshot())


@pytest.mark.parametrize("kept", [5, 500])
@pytest.mark.parametrize("seed", range(2))
def test_the_evidence_for_each_fact_survives(
    tmp_path: Path, seed: int, kept: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("skillc_runtime.world.state.evidence.MAX_WRITES", kept)
    chance = Random(seed)
    with opened(tmp_path, DiskStore) as (world, journal, _):
        for _ in range(30):
            write(world, chance)
        journal.commit()
        before = evidence(world)
    with opened(tmp_path, DiskStore) as (again, _, _):
        assert evidence(again) == before
    assert len(set(before.values())) >= 3


@pytest.mark.parametrize("kept", [3, 8, 500])
@pytest.mark.parametrize("seed", range(2))
def test_of_a_long_history_only_the_last_writes_are_read(
    tmp_path: Path, seed: int, kept: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("skillc_runtime.world.state.evidence.MAX_WRITES", kept)
    monkeypatch.setattr("skillc.cells.evidence.PERIOD", 7)
    chance = Random(f"long {seed}")
    for _ in range(3):
        with opened(tmp_path, DiskStore) as (world, journal, _), reading(journal.path) as reader:
            keeper = EvidenceKeeper(world, journal, reader)
            for _ in range(chance.randint(5, 25)):
                write(world, chance)
                keeper.keep()
                journal.commit()
            before, facts = evidence(world), facts_of(world.snapshot())
        with opened(tmp_path, DiskStore) as (again, journal, _), reading(journal.path) as reader:
            assert (evidence(again), facts_of(again.snapshot())) == (before, facts)
            merged = read_merged(reader)
            assert merged is not None and len(reader.writes(merged.sequence)) < kept + 7


def test_a_world_that_is_older_than_the_journal_is_refused(tmp_path: Path) -> None:
    chance = Random(1)
    with opened(tmp_path, DiskStore) as (world, journal, _):
        write(world, chance)
        journal.commit()
    with closing(sqlite3.connect(tmp_path / "journal.sqlite")) as connection, connection:
        connection.execute("UPDATE transactions SET sequence = sequence + 5")
    with refused_as_different(), opened(tmp_path, DiskStore):
        pass


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize("own_writes", [0, 3])
def test_a_store_to_which_others_wrote_is_refused_until_a_person_adopts_it(
    tmp_path: Path, own_writes: int, known: bool
) -> None:
    chance = Random(own_writes)
    with opened(tmp_path, DiskStore) as (world, journal, _):
        for _ in range(own_writes):
            write(world, chance)
        journal.commit()
    with closing(DiskStore(tmp_path / "world")) as store:
        model_of(store).commit([assign("box", "weight", 77.0)], "somebody else")
    if not known:
        forget_fingerprint(tmp_path)
    if known or own_writes:
        with refused_as_different(), opened(tmp_path, DiskStore):
            pass
        assert adopt_world(tmp_path, "bo", "I weighed it") == own_writes + 3
    with opened(tmp_path, DiskStore) as (world, journal, _), reading(journal.path) as reader:
        assert world.snapshot().value(iri("box"), iri("weight")) == 77.0
        if known or own_writes:
            assert set(evidence(world).values()) == {"given"}
            assert reader.latest_writes(100, 1)[0].transaction.origin == "bo: I weighed it"
        write(world, chance)
        journal.commit()
        facts = facts_of(world.snapshot())
    with opened(tmp_path, DiskStore) as (again, _, _):
        assert facts_of(again.snapshot()) == facts


@pytest.mark.parametrize("ahead", [False, True])
def test_a_store_with_other_facts_under_the_same_number_is_refused(tmp_path: Path, ahead: bool) -> None:
    """The same number says nothing: here the journal has a write of its own, and the store has one of others."""
    with opened(tmp_path, BrokenStore) as (world, journal, store):
        store.fails = True
        for name, value in (("weight", 5.0), ("label", "heavy"))[: 1 + ahead]:
            world.commit([assign("box", name, value)])
        with pytest.raises(NotDurable):
            journal.commit()
    with closing(DiskStore(tmp_path / "world")) as others:
        model_of(others).commit([assign("box", "weight", 77.0)], "somebody else")
    with refused_as_different(), opened(tmp_path, DiskStore):
        pass
    with closing(DiskStore(tmp_path / "world")) as others:
        assert model_of(others).snapshot().value(iri("box"), iri("weight")) == 77.0
        assert others.read().sequence == 2, "nothing is written to a store that is refused"
    assert adopt_world(tmp_path, "bo", "I weighed it") == 3 + ahead
    with opened(tmp_path, DiskStore) as (world, _, _):
        assert world.snapshot().value(iri("box"), iri("weight")) == 77.0


def test_a_write_that_the_store_did_not_take_is_given_to_it_again(tmp_path: Path) -> None:
    with opened(tmp_path, BrokenStore) as (world, journal, store):
        store.fails = True
        world.commit([assign("box", "weight", 5.0)])
        with pytest.raises(NotDurable, match="the disk is gone"):
            journal.commit()
        with pytest.raises(NotDurable, match="the disk is gone"):
            journal.commit()
        store.fails = False
        world.commit([assign("box", "label", "heavy")])
        journal.commit()
        assert facts_of(model_of(store).snapshot()) == facts_of(world.snapshot())


def test_a_store_that_others_wrote_to_stays_a_fault(tmp_path: Path) -> None:
    with opened(tmp_path, DiskStore) as (world, journal, store):
        model_of(store).commit([assign("box", "weight", 77.0)], "past the lock")
        world.commit([assign("box", "weight", 5.0)])
        for _ in range(3):
            with pytest.raises(NotDurable, match="was written to by others, and the cell cannot go on with it"):
                journal.commit()
    with refused_as_different(), opened(tmp_path, DiskStore):
        pass


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("PRAGMA user_version = 99", f"format 99 of a newer skillc; this one reads up to {SCHEMA.format}"),
        ("CREATE TABLE recipes (name TEXT)", "is a database of something else"),
    ],
)
def test_what_is_no_journal_is_refused(tmp_path: Path, content: str, message: str) -> None:
    path = tmp_path / "journal.sqlite"
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute(content)
    with pytest.raises(DatabaseError, match=message):
        CellJournal(path, NullStore())


def test_a_damaged_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "journal.sqlite"
    path.write_bytes(b"SQLite format 3\0" + bytes(range(256)) * 40)
    with pytest.raises(DatabaseError, match=r"journal.sqlite is damaged .*; restore a backup"):
        CellJournal(path, NullStore())


def refused_as_different() -> pytest.RaisesExc[DatabaseError]:
    return pytest.raises(
        DatabaseError, match=r"does not have the facts that its cell wrote.* `skillc state restore`, or"
    )


def forget_fingerprint(folder: Path) -> None:
    """Make the journal one of a skillc that kept no fingerprints."""
    with closing(sqlite3.connect(folder / "journal.sqlite")) as connection, connection:
        connection.execute("DELETE FROM cell_state WHERE name = ?", (FINGERPRINT,))


StoreT = TypeVar("StoreT", bound=DiskStore)


@contextmanager
def opened(folder: Path, kind: type[StoreT]) -> Iterator[tuple[WorldModel, CellJournal, StoreT]]:
    """Open a store with the laboratory, and the journal in front of it, as a cell does."""
    with closing(kind(folder / "world")) as store:
        stored = model_of(store).snapshot()
        found = make_fingerprint(store.read())
        with closing(CellJournal(folder / "journal.sqlite", store)) as journal, reading(journal.path) as reader:
            yield restore_world(store, stored, found, journal, reader), journal, store


def write(world: WorldModel, chance: Random) -> None:
    """Make one random write that the axioms allow."""
    while True:
        with suppress(WorldError):
            world.commit(random_write(chance), "random", chance.choice(EVIDENCE))
            return


def evidence(world: WorldModel) -> dict[Fact, str]:
    """Return how every fact is known that could be one."""
    state = world.snapshot()
    names = sorted(map(iri, (*PLACES, *THINGS)))
    facts: list[Fact] = [PropertyFact(iri("box"), iri(each)) for each in ("weight", "label")]
    for relation, subject, object_ in product(("at", "contain", "within-it", "near", "beside"), names, names):
        facts.append(RelationFact(subject, iri(relation), object_, state.holds(subject, iri(relation), object_)))
    return {each: describe_evidence(world.deciding_write(each)) for each in facts}
