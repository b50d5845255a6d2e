"""A server encrypts, takes requests from its proxy only, answers to its names, and is not kept busy by connections."""

from __future__ import annotations

import asyncio
import json
import socket
from contextlib import AbstractContextManager, AsyncExitStack, ExitStack

import httpx
import pytest
import uvicorn
from prometheus_client.parser import text_string_to_metric_families
from prometheus_client.samples import Sample
from starlette.applications import Starlette
from starlette.responses import PlainTextResponse
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp
from starlette.websockets import WebSocket
from websockets.asyncio.client import connect

from server.running import RunningServer, serving_app, wait_until
from skillc.server.app import ProxiedRequests
from skillc.server.http import connections
from skillc.server.http.connections import BoundedConnection

HERE = PlainTextResponse("here")


def test_with_a_certificate_it_encrypts_and_answers_to_its_names(encrypted: RunningServer) -> None:
    assert encrypted.client.get("/cells", headers={"Host": "cells.example.org"}).status_code == 200
    assert encrypted.client.get("/cells", headers={"Host": "example.org"}).status_code == 421
    with pytest.raises(httpx.ConnectError, match="verify failed"):
        httpx.get(f"{encrypted.url}/cells")
    with pytest.raises(httpx.HTTPError):
        httpx.get(f"{encrypted.url.replace('https', 'http')}/cells")


def test_behind_a_proxy_its_clients_are_those_that_the_proxy_names(proxied: RunningServer) -> None:
    for claimed in ("10.1.2.3", "6.6.6.6, 10.1.2.3"):
        proxied.client.post("/cells/yard/stop", json={}, headers={"X-Forwarded-For": claimed})
    entries = proxied.client.get("/audit", params={"limit": 10_000}).json()
    assert [each["origin"] for each in entries if each["action"].startswith("POST /api/v1/cells/yard/stop")] == [
        "10.1.2.3",
        "10.1.2.3",
    ]
    proxied.client.get("/cells/a%0A%7B%22event%22:%22forged%22%7D")
    log = (proxied.folder / "log").read_text()
    lines = [json.loads(line) for line in log.splitlines()]
    assert {"cell", "request"} == {each["event"] for each in lines} and proxied.token not in log
    assert next(each for each in lines if each["event"] == "request")["who"] == "admin"


@pytest.mark.parametrize(("address", "status"), [("10.0.0.9", 200), ("10.0.0.8", 403)])
def test_behind_a_proxy_nobody_else_is_answered(address: str, status: int) -> None:
    transport = httpx.ASGITransport(ProxiedRequests(PlainTextResponse("here"), "10.0.0.9"), client=(address, 1))

    async def get() -> httpx.Response:
        async with httpx.AsyncClient(transport=transport, base_url="http://cells") as client:
            return await client.get("/")

    answer = asyncio.run(get())
    assert answer.status_code == status and ("from its proxy only" in answer.text) == (status == 403)


def read_metrics(server: RunningServer) -> dict[str, list[Sample]]:
    """Return the samples of a server's metrics by the names of their families."""
    text = httpx.get(server.url.replace("/api/v1", "/metrics"), headers=server.client.headers).text
    return {each.name: each.samples for each in text_string_to_metric_families(text)}


def count_ticks(found: dict[str, list[Sample]]) -> dict[str, float]:
    """Return how many ticks came within each interval, and under other names what else is told of them."""
    return {each.labels.get("le", each.name): each.value for each in found["skillc_tick_interval_seconds"]}


def test_prometheus_reads_its_metrics(server: RunningServer) -> None:
    server.client.get("/cells/nowhere")
    server.put_back()
    operation = server.submit(task="carry_all")["id"]
    server.wait_for(operation, "running", "succeeded")
    server.client.post(f"/operations/{operation}/stop", json={})
    server.wait_for(operation, "stopped", "succeeded")
    found = wait_until(lambda: read_metrics(server), lambda it: count_ticks(it)["+Inf"] > count_ticks(it)["0.005"])
    states = {sample.labels["state"]: sample.value for sample in found["skillc_cell_state"]}
    assert states["operational"] == 1.0 and states["fault"] == 0.0
    ticks = count_ticks(found)
    assert ticks["0.005"] >= 0.0 and ticks["skillc_tick_interval_seconds_sum"] > 0.0
    missing = {"method": "GET", "path": "/cells/{cell}", "status": "404"}
    counts = [each.value for each in found["skillc_request_seconds"] if each.labels == missing and "count" in each.name]
    assert len(counts) == 1 and counts[0] >= 1.0
    assert httpx.get(server.url.replace("/api/v1", "/metrics")).status_code == 401


def test_who_connects_and_says_nothing_keeps_nobody_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "MAX_CONNECTIONS", 5)
    with bounded_server() as port, ExitStack() as stack:
        idle = [stack.enter_context(socket.create_connection(("127.0.0.1", port))) for _ in range(20)]
        assert httpx.get(f"http://127.0.0.1:{port}/").text == "here"
        idle[0].settimeout(60.0)
        assert idle[0].recv(1) == b"", "the one that has been idle for longest is closed"


def test_websockets_are_not_counted_as_connections_that_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "MAX_CONNECTIONS", 3)

    async def listen(socket: WebSocket) -> None:
        await socket.accept()
        await socket.receive()

    async def ask(port: int) -> None:
        async with AsyncExitStack() as stack, httpx.AsyncClient() as client:
            for _ in range(10):
                await stack.enter_async_context(connect(f"ws://127.0.0.1:{port}/"))
            assert (await client.get(f"http://127.0.0.1:{port}/here")).text == "here"

    here = Route("/here", lambda _: PlainTextResponse("here"))
    with bounded_server(Starlette(routes=[here, WebSocketRoute("/", listen)])) as port:
        asyncio.run(ask(port))


@pytest.mark.parametrize("sent", [b"", b"GET / HTT", b"GET / HTTP/1.1\r\nHost: a\r\n\r\nGET / HTTP/1.1\r\nX: "])
def test_a_request_that_does_not_arrive_ends_its_connection(monkeypatch: pytest.MonkeyPatch, sent: bytes) -> None:
    monkeypatch.setattr(connections, "REQUEST_S", 0.3)
    with bounded_server() as port, socket.create_connection(("127.0.0.1", port)) as slow:
        slow.settimeout(10.0)
        slow.sendall(sent)
        while slow.recv(4096):
            pass


def bounded_server(app: ASGIApp = HERE) -> AbstractContextManager[int]:
    """Serve an application, a constant answer without one, with bounded connections; yields the port."""
    return serving_app(uvicorn.Config(app, http=BoundedConnection, log_config=None, lifespan="off"))
