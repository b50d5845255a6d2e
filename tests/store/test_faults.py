"""A network that loses, delays and garbles: clear words, nothing lost, nothing twice, and on as soon as it works."""

import threading
import traceback
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from concurrent.futures import TimeoutError as FutureTimeout
from random import Random
from urllib.parse import urlsplit

import pyoxigraph as ox
import pytest

from skillc.services.scene.stores import StoreChoice, open_store
from skillc_runtime.store import http
from skillc_runtime.store.address import Address
from skillc_runtime.store.http import HttpEndpoint, InvalidAnswer, RequestRefused, ServerUnreachable, find_endpoint
from skillc_runtime.store.sparql import SparqlStore
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError
from store.proxy import FAULTS, Fault, Proxy, proxy_to
from store.servers import oxigraph
from store.worlds import commits, facts_of, model_of
from waiting import LONG_S
from world.lab import assign, iri

SHORT_S = 0.3
WORDS: dict[Fault, str] = {
    "lost request": "the connection was lost",
    "lost answer": "the connection was lost",
    "reset": "the connection was lost",
    "half an answer": "the connection was lost|it does not speak HTTP",
    "error 500": "answers 500 Internal Server Error: the disk is full",
    "error 503": "answers 503 Service Unavailable: the disk is full",
    "garbage": "answers a query with an invalid result",
    "page": "answers with text/html where application/sparql-results",
    "slow": "no answer within 0.3 s",
    "other rows": "answers a query with an invalid result",
    "long number": "answers a query with an invalid result",
    "echo": "answers 500 Internal Server Error: /",
}


@pytest.fixture
def server() -> Iterator[str]:
    with oxigraph() as address:
        yield address


@pytest.fixture
def proxy(server: str) -> Iterator[Proxy]:
    with proxy_to(server) as between:
        yield between


def store_at(address: str, patience_s: float = LONG_S, fault: Fault | None = None) -> SparqlStore:
    """Return a store that waits for answers for as long as a busy machine may need, unless they are to be too slow."""
    timeout_s = SHORT_S if fault == "slow" else LONG_S
    return SparqlStore(HttpEndpoint(address, "/query", "/update", timeout_s), patience_s=patience_s)


@pytest.mark.slow
@pytest.mark.parametrize("fault", FAULTS)
def test_a_passing_fault_is_not_noticed(server: str, proxy: Proxy, fault: Fault) -> None:
    model, other = model_of(store_at(proxy.address, fault=fault)), model_of(store_at(server))
    proxy.fail(fault, 2)
    model.commit([assign("box", "weight", 8.0)], "weighing")
    heard: list[ChangeEvent] = []
    other.subscribe(heard.append)
    other.follow()
    assert [event.origin for event in heard] == ["weighing"]
    assert proxy.next_fault() is None, "all faults happened"


@pytest.mark.slow
@pytest.mark.parametrize("fault", FAULTS)
def test_a_lasting_fault_is_told_and_over_when_it_is_over(server: str, proxy: Proxy, fault: Fault) -> None:
    model, other = model_of(store_at(proxy.address, 0.2, fault)), model_of(store_at(server))
    before, heard = model.snapshot(), list[str]()
    other.subscribe(lambda event: heard.append(event.origin))
    proxy.fail(fault, 1000)
    with pytest.raises(ServerUnreachable, match=WORDS[fault]):
        model.commit([assign("box", "weight", 8.0)], "first")
    assert model.snapshot() is before
    proxy.fail(fault, 0)
    model.commit([assign("arm", "state", "Fault")], "second")
    other.follow()
    assert heard in (["first", "second"], ["second"]) and ("first" in heard or fault not in ("lost answer", "slow"))
    assert facts_of(model.snapshot()) == facts_of(other.snapshot())
    assert (model.snapshot().value(iri("box"), iri("weight")) == 8.0) == ("first" in heard)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_among_random_faults_nothing_is_lost_or_done_twice(server: str, proxy: Proxy, seed: int) -> None:
    chance, lock = Random(seed), threading.Lock()
    models = [model_of(store_at(proxy.address)) for _ in range(2)]
    told: list[list[str]] = [[], []]

    def fault() -> Fault | None:
        with lock:
            return chance.choice([each for each in FAULTS if each != "slow"]) if chance.random() < 0.25 else None

    def write(number: int) -> None:
        for event in commits(models[number], Random(10 * seed + number), 8):
            told[number].append(f"{event.origin} {hash(event.changes)}")

    proxy.next_fault = fault
    with ThreadPoolExecutor() as threads:
        list(threads.map(write, range(2)))
    proxy.next_fault = lambda: None
    for model in models:
        model.follow()
    written = [f"{each.origin} {hash(each.changes)}" for each in store_at(server).since(1)]
    assert len(written) == 16 and sorted(written) == sorted(told[0] + told[1])
    assert [each for each in written if each in set(told[0])] == told[0]
    assert facts_of(models[0].snapshot()) == facts_of(models[1].snapshot())
    assert facts_of(model_of(store_at(server)).snapshot()) == facts_of(models[0].snapshot())


def test_a_write_waits_for_a_server_that_is_started_anew() -> None:
    kept = ox.Store()
    with oxigraph(kept) as address:
        store = store_at(address)
        model = model_of(store)
        store.close()
    with ThreadPoolExecutor() as threads:
        writing = threads.submit(model.commit, [assign("box", "weight", 8.0)], "meanwhile")
        with pytest.raises(FutureTimeout):
            writing.result(0.15)
        with oxigraph(kept, urlsplit(address).port or 0):
            assert writing.result().origin == "meanwhile"
            assert [each.origin for each in store.since(1)] == ["meanwhile"]


def test_a_server_that_is_not_there_is_told() -> None:
    with oxigraph() as address:
        pass
    with pytest.raises(StoreError, match=r"127\.0\.0\.1:\d+/? does not answer: no server is listening there"):
        open_store(address)


def test_a_host_that_does_not_exist_is_told() -> None:
    with pytest.raises(StoreError, match=r"http://nowhere\.invalid does not answer: "):
        open_store("http://nowhere.invalid")


def test_a_server_of_something_else_is_told(server: str, proxy: Proxy) -> None:
    with pytest.raises(StoreError, match=r"no SPARQL 1\.1 server accepts queries and updates at .*/wrong: .*404"):
        open_store(f"{server}/wrong")
    proxy.fail("page", 100)
    with pytest.raises(StoreError, match=r"no SPARQL 1\.1 server .* answers with text/html"):
        open_store(proxy.address)


def test_an_update_that_is_refused_is_not_tried_again(server: str, proxy: Proxy) -> None:
    endpoint = find_endpoint(proxy.address)
    before = proxy.requests
    with pytest.raises(RequestRefused, match="answers 400 Bad Request"):
        endpoint.update("INSERT nonsense")
    assert proxy.requests == before + 1


@pytest.mark.parametrize("fault", ["trickle", "trickling head"])
def test_an_answer_that_never_ends_is_given_up(proxy: Proxy, fault: Fault) -> None:
    proxy.fail(fault, 1)
    endpoint = HttpEndpoint(proxy.address, "/query", "/update", 0.05)
    with pytest.raises(ServerUnreachable, match=r"no answer within 0.05 s, or not a complete one within 0.3 s"):
        endpoint.query("ASK {}", "text/csv")


def test_an_answer_that_is_too_large_is_not_read(proxy: Proxy, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(http, "MAX_ANSWER_BYTES", 10)
    with pytest.raises(InvalidAnswer, match=r"answers with more than 0 MB, which is too much for a world"):
        HttpEndpoint(proxy.address, "/query", "/update").query("ASK {}", "application/sparql-results+json")


def test_a_server_that_sends_on_is_told_with_where_to(proxy: Proxy) -> None:
    proxy.fail("moved", 100)
    with pytest.raises(
        StoreError, match=r"answers 307 .*: it redirects to http://elsewhere\.invalid/x; use that address"
    ):
        open_store(proxy.address)


SECRETS = (
    "http://ann:xy%3Azzy@{host}",
    "http://ann:xy%3Azzy@{host}/?access=xy%3Azzy",
    "http://{host}?key=xy%3Azzy",
)
MALFORMED = (
    "http://ann:xy:zzy@",
    "http://ann:xy:zzy@[::1",
    "http://ann:xy:zzy@host:port",
    "http://ann:1/xy:zzy@host",
    "http://ann:1?xy:zzy@host",
    "http://ann:1#xy:zzy@host",
    "http://ann:xy:zzy @host",
    "http://ann:xy:zzy\u00e9@host",
    "http://host/?key=xy:zzy#xy:zzy",
    "ftp://ann:xy:zzy@host",
    "x://ann:xy:zzy@host?xy:zzy",
)


@pytest.mark.slow
@pytest.mark.parametrize("address", SECRETS)
@pytest.mark.parametrize("fault", [*FAULTS, "moved"])
def test_credentials_are_in_no_message(proxy: Proxy, fault: Fault, address: str) -> None:
    place = address.format(host=urlsplit(proxy.address).netloc)
    endpoint = HttpEndpoint(place, "/query", "/update", 0.05)
    proxy.fail(fault, 100)
    shown = [
        str(endpoint),
        repr(endpoint),
        repr(StoreChoice(place)),
        StoreChoice(place).name,
        repr(Address.parse(place)),
    ]
    for ask in (lambda: endpoint.query("ASK {}", "text/csv"), lambda: SparqlStore(endpoint, patience_s=0.0).read()):
        try:
            ask()
        except StoreError as error:
            shown += traceback.format_exception(error)
    assert len(shown) > 5 and "zzy" not in "".join(shown)


@pytest.mark.parametrize("address", MALFORMED)
def test_credentials_are_in_no_message_about_a_malformed_address(address: str) -> None:
    with pytest.raises(StoreError) as caught:
        open_store(address)
    assert "zzy" not in "".join(traceback.format_exception(caught.value))


def test_a_token_in_the_query_is_sent_with_every_request(proxy: Proxy) -> None:
    endpoint = find_endpoint(f"{proxy.address}?key=secret")
    endpoint.query("ASK {}", "application/sparql-results+json")
    assert proxy.paths[-1] == "/query?key=secret" and str(endpoint) == proxy.address


def test_a_password_is_sent_and_never_shown(proxy: Proxy) -> None:
    address = proxy.address.replace("http://", "http://ann:se%3Acret@")
    endpoint = find_endpoint(address)
    assert proxy.authorization == "Basic YW5uOnNlOmNyZXQ=" and str(endpoint) == proxy.address
    proxy.fail("error 500", 1)
    with pytest.raises(ServerUnreachable) as caught:
        endpoint.query("ASK {}", "text/csv")
    assert "cret" not in str(caught.value)
