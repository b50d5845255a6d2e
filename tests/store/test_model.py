"""A world model and its store: what is kept, what others wrote, what happens when both write at once."""

import pytest

from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError
from store.memory import MemoryStore
from store.worlds import facts_of, model_of
from world.lab import assign, fact, iri


def two() -> tuple[WorldModel, WorldModel, MemoryStore]:
    store = MemoryStore()
    return model_of(store), model_of(store), store


def test_what_one_writes_the_other_hears_of_in_order() -> None:
    one, other, _ = two()
    heard: list[ChangeEvent] = []
    other.subscribe(heard.append)
    first = one.commit([assign("box", "weight", 4.0)], "weighing")
    second = one.commit([fact("shelf", "contain", "box")], "moving")
    assert not heard
    other.follow()
    assert [(each.origin, each.changes) for each in heard] == [(e.origin, e.changes) for e in (first, second)]
    assert heard[0].after is heard[1].before and heard[1].after is other.snapshot()
    assert facts_of(one.snapshot()) == facts_of(other.snapshot())


def test_a_write_that_comes_second_is_made_to_what_the_first_left() -> None:
    one, other, store = two()
    store.interfere = lambda: one.commit([assign("arm", "state", "Fault")], "breaking") and None
    heard: list[str] = []
    other.subscribe(lambda event: heard.append(event.origin))
    event = other.commit([fact("table", "contain", "eraser")], "placing")
    assert heard == ["breaking", "placing"]
    assert event.before.value(iri("arm"), iri("state")) == "Fault"
    assert [each.origin for each in store.written[1:]] == heard


def test_a_write_that_the_first_made_impossible_is_refused_and_not_kept() -> None:
    one, other, store = two()
    store.interfere = lambda: one.commit([fact("shelf", "contain", "gripper")], "storing") and None
    with pytest.raises(WorldError, match="asymmetric"):
        other.commit([fact("gripper", "contain", "shelf")], "absurd")
    assert [each.origin for each in store.written[1:]] == ["storing"]
    assert facts_of(one.snapshot()) == facts_of(other.snapshot())


def test_a_store_that_cannot_keep_a_write_leaves_the_world_as_it_was() -> None:
    one, _, store = two()
    before, heard = one.snapshot(), list[ChangeEvent]()
    one.subscribe(heard.append)
    store.broken = True
    with pytest.raises(StoreError, match="gone"):
        one.commit([assign("box", "weight", 5.0)])
    assert one.snapshot() is before and not heard
    store.broken = False
    assert one.commit([assign("box", "weight", 5.0)]).after is one.snapshot()
