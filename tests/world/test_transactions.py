"""Transactions are made whole or not at all, and taken back exactly."""

from __future__ import annotations

import os
from random import Random
from threading import Event, Thread

import pytest

from skillc_runtime.world.state import evidence
from skillc_runtime.world.state.difference import changes_between
from skillc_runtime.world.state.model import MAX_UNDO, WorldError, WorldModel
from skillc_runtime.world.state.names import NoSuchName
from skillc_runtime.world.state.transactions import ChangeEvent
from store.test_model import two
from store.worlds import commits
from world.lab import SCENE, assign, fact, individual, iri
from world.sameness import everything

SEEDS = range(int(os.environ.get("WORLD_SEEDS", "15")))


def test_a_transaction_is_one_write() -> None:
    model, events = WorldModel(SCENE), list[ChangeEvent]()
    model.subscribe(events.append)
    with model.transaction("tidy") as now:
        made = now.create("t:crate", "t:Product")
        now.set("t:crate", "t:weight", 2.0)
        now.relate("t:table", "t:contain", "t:crate")
        now.unrelate("t:shelf", "t:contain", "t:eraser")
        now.clear("t:box", "t:label")
        now.remove("t:board")
        assert now.state.holds(iri("table"), iri("contain"), made) and model.snapshot() is SCENE
    (event,) = events
    assert (event.origin, event.before, len(event.changes)) == ("tidy", SCENE, 6)
    assert model.snapshot() is event.after and event.after.subjects(iri("contain"), made) == {iri("table")}
    assert iri("board") not in event.after.individuals and event.after.value(iri("box"), iri("label")) is None


def test_a_block_that_raises_or_is_refused_writes_nothing() -> None:
    model = WorldModel(SCENE)
    with pytest.raises(ZeroDivisionError), model.transaction() as now:
        now.create("t:crate", "t:Product")
        print(1 / 0)
    with pytest.raises(WorldError, match="irreflexive"), model.transaction() as now:
        now.create("t:crate", "t:Product")
        now.relate("t:table", "t:contain", "t:table")
    assert model.snapshot() is SCENE
    with model.transaction():
        pass
    assert model.snapshot() is SCENE


def test_a_transaction_within_another_is_refused() -> None:
    model = WorldModel(SCENE)
    with model.transaction() as now:
        now.set("t:box", "t:weight", 1.0)
        with pytest.raises(WorldError, match="open already"), model.transaction():
            pytest.fail("it was let in")
        with pytest.raises(WorldError, match="is open"):
            model.commit([assign("box", "weight", 2.0)])
        with pytest.raises(WorldError, match="is open"):
            model.undo()
    assert model.snapshot().value(iri("box"), iri("weight")) == 1.0
    model.commit([assign("box", "weight", 2.0)])


def test_others_wait_with_their_writes_and_go_on_reading() -> None:
    model, written, read = WorldModel(SCENE), Event(), list[object]()
    other = Thread(target=lambda: (model.commit([assign("box", "weight", 9.0)]), written.set()))
    with model.transaction() as now:
        now.set("t:box", "t:weight", 1.0)
        other.start()
        reader = Thread(target=lambda: read.append(model.snapshot().value(iri("box"), iri("weight"))))
        reader.start()
        reader.join()
        assert read == [3] and not written.wait(0.05)
    other.join()
    assert written.is_set() and model.snapshot().value(iri("box"), iri("weight")) == 9.0


def test_names_that_there_are_not_are_refused_where_they_are_written() -> None:
    model = WorldModel(SCENE)
    with pytest.raises(NoSuchName, match="there is no prefix `x`; there is t"), model.transaction() as now:
        now.create("x:crate", "t:Product")
    with pytest.raises(NoSuchName, match="neither an IRI nor PREFIX:NAME"), model.transaction() as now:
        now.remove("box")
    with pytest.raises(ValueError, match="no relation or property t:wieght"), model.transaction() as now:
        now.set("t:box", "t:wieght", 1.0)


@pytest.mark.parametrize("seed", SEEDS)
def test_undoing_leads_back_through_every_version(seed: int) -> None:
    model = WorldModel(SCENE)
    versions = [event.before for event in commits(model, Random(seed), 12)]
    assert len(versions) == 12
    for version in reversed(versions):
        event = model.undo()
        assert everything(event.after) == everything(version)
    with pytest.raises(WorldError, match="nothing to undo"):
        model.undo()


@pytest.mark.parametrize("seed", SEEDS)
def test_changes_between_two_versions_lead_from_one_to_the_other(seed: int) -> None:
    *_, one = commits(WorldModel(SCENE), Random(seed), 10)
    *_, other = commits(WorldModel(SCENE), Random(seed + 1000), 10)
    found = changes_between(one.after, other.after)
    assert everything(one.after.with_changes(found)) == everything(other.after)
    assert changes_between(one.after, one.after) == () and found == changes_between(one.after, other.after)


@pytest.mark.parametrize("seed", SEEDS)
def test_writes_of_the_ledger_lead_back_also_those_that_are_merged(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(evidence, "MAX_WRITES", 4)
    model = WorldModel(SCENE)
    list(commits(model, Random(seed), 12))
    writes = model.ledger.writes
    assert len(writes) == 4
    for each in writes:
        assert everything(each.after.with_changes(each.undoable.undo)) == everything(each.before)
    assert all(one.undoable is other.undoable for one, other in zip(writes, model.ledger.writes, strict=True)), (
        "found once"
    )


def test_what_others_wrote_since_is_not_taken_back() -> None:
    one, other, _ = two()
    one.commit([assign("box", "weight", 1.0)])
    other.commit([assign("box", "weight", 2.0)])
    with pytest.raises(WorldError, match="others wrote"):
        one.undo()
    assert one.snapshot().value(iri("box"), iri("weight")) == 2.0
    other.undo()
    one.follow()
    assert one.snapshot().value(iri("box"), iri("weight")) == 1.0


def test_a_class_and_what_was_implied_are_taken_back() -> None:
    model = WorldModel(SCENE)
    model.commit([individual("arm", "Holder"), fact("arm", "hasA", "gripper")])
    model.undo()
    assert everything(model.snapshot()) == everything(SCENE)


def test_only_the_last_writes_can_be_taken_back() -> None:
    model = WorldModel(SCENE)
    for number in range(MAX_UNDO + 5):
        model.commit([assign("box", "weight", float(number))])
    taken = 0
    while taken <= MAX_UNDO:
        try:
            model.undo()
        except WorldError:
            break
        taken += 1
    assert taken == MAX_UNDO and model.snapshot().value(iri("box"), iri("weight")) == 4.0


def test_a_version_never_changes() -> None:
    model = WorldModel(SCENE)
    kept = [(event.after, everything(event.after)) for event in commits(model, Random(7), 40)]
    model.undo()
    assert len(kept) == 40 and all(everything(version) == then for version, then in kept)
