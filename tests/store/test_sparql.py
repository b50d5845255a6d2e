"""Stores on SPARQL servers that are really there: kept, shared, filled anew."""

import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from random import Random

import pytest

from skillc.services.scene.stores import open_store
from skillc_runtime.store.http import HttpEndpoint
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import StoreError
from store.actors import write
from store.processes import Actor
from store.servers import SERVERS
from store.worlds import commits, facts_of, model_of
from world.lab import SCENE, assign, iri

THREADS, WRITES = 3, 4


BY_ALL_SERVERS = pytest.mark.parametrize("server", sorted(SERVERS), indirect=True)
"""For what servers may differ in; the rest is asked of the fastest one."""


@pytest.fixture(scope="module")
def server(request: pytest.FixtureRequest) -> Iterator[str]:
    with SERVERS[getattr(request, "param", "oxigraph")]() as address:
        yield address


@pytest.fixture
def empty(server: str) -> str:
    open_store(server, reset=True).close()
    return server


@pytest.mark.slow
@BY_ALL_SERVERS
def test_what_is_written_is_there_for_the_next_process(empty: str) -> None:
    first = open_store(empty)
    model = model_of(first)
    assert facts_of(model.snapshot()) == facts_of(SCENE)
    *_, last = commits(model, Random(4), 15)
    first.close()
    second = open_store(empty)
    again, kept = model_of(second), second.read()
    assert facts_of(again.snapshot()) == facts_of(last.after)
    assert kept.beginning == "scene lab.ttl 0123456789ab"
    second.close()


def test_those_who_write_at_once_agree_on_one_order(empty: str) -> None:
    models = [model_of(open_store(empty)) for _ in range(THREADS)]
    heard: list[list[str]] = [[] for _ in models]
    for model, origins in zip(models, heard, strict=True):
        model.subscribe(lambda event, origins=origins: origins.append(event.origin))  # type: ignore[misc]
    with ThreadPoolExecutor() as threads:
        list(threads.map(_write, models, range(THREADS)))
    for model in models:
        model.follow()
    assert heard[0] == heard[1] == heard[2] and len(heard[0]) == THREADS * WRITES
    assert len({facts_of(model.snapshot()) for model in models}) == 1
    assert facts_of(model_of(open_store(empty)).snapshot()) == facts_of(models[0].snapshot())


@BY_ALL_SERVERS
def test_processes_share_a_server_and_one_that_is_killed_leaves_nothing_half_done(empty: str) -> None:
    store = open_store(empty)
    model = model_of(store)
    filled = store.read().sequence
    doomed, other = Actor(write, empty, 1, 1000, "doomed"), Actor(write, empty, 2, WRITES, "other")
    acknowledged = [doomed.hear() for _ in range(3)]
    time.sleep(Random(6).random() * 0.05)
    doomed.kill()
    acknowledged += doomed.told()
    others = other.told()
    assert other.process.exitcode == 0 and len(others) == WRITES
    origins = [each.origin for each in store.since(filled)]
    assert [each for each in origins if each.startswith("other")] == others
    made = [each for each in origins if each.startswith("doomed")]
    assert made[: len(acknowledged)] == acknowledged and len(made) <= len(acknowledged) + 1
    model.follow()
    assert facts_of(model.snapshot()) == facts_of(model_of(open_store(empty)).snapshot())


def _write(model: WorldModel, number: int) -> None:
    for count in range(WRITES):
        model.commit([assign("box", "weight", float(10 * number + count))], f"{number}: {count}")


def test_whoever_knows_a_world_that_was_replaced_is_told(empty: str) -> None:
    old = model_of(open_store(empty))
    old.commit([assign("box", "weight", 8.0)])
    new = model_of(open_store(empty, reset=True))
    assert new.snapshot().value(iri("box"), iri("weight")) == 3.0
    before = old.snapshot()
    with pytest.raises(StoreError, match=r"was reset by another process; start again"):
        old.follow()
    with pytest.raises(StoreError, match=r"was reset by another process; start again"):
        old.commit([assign("box", "weight", 9.0)])
    assert old.snapshot() is before
    new.commit([assign("box", "weight", 4.0)])


def test_facts_of_others_on_the_server_stay(empty: str) -> None:
    store = open_store(empty)
    endpoint = store._endpoint  # type: ignore[attr-defined]
    assert isinstance(endpoint, HttpEndpoint)
    endpoint.update('INSERT DATA { GRAPH <http://others/graph> { <http://others/a> <http://others/b> "c" } }')
    *_, last = commits(model_of(store), Random(5), 3)
    open_store(empty, reset=True)
    rows = endpoint.query("SELECT ?s { GRAPH <http://others/graph> { ?s ?p ?o } }", "application/sparql-results+json")
    assert b"http://others/a" in rows and last.after is not SCENE


def test_a_store_that_somebody_removed_is_told(empty: str) -> None:
    store = open_store(empty)
    model = model_of(store)
    store._endpoint.update("DELETE { GRAPH ?g { ?s ?p ?o } } WHERE { GRAPH ?g { ?s ?p ?o } }")  # type: ignore[attr-defined]
    with pytest.raises(StoreError, match="holds no world any more"):
        model.commit([assign("box", "weight", 8.0)])
