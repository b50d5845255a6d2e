"""Who attacks a server is refused with a status, and neither disturbs an operation nor keeps a stop from it."""

from __future__ import annotations

import asyncio
import json
import os
import socket
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import AsyncExitStack

import httpx
import pytest
import uvicorn
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from server.attacking import ATTACKS, Attack, forge_entries, make_attacker
from server.running import RunningServer, serving, serving_app
from skillc.server.access.watchers import MAX_UNKNOWN
from skillc.server.http import requests
from skillc.server.problems import ApiRefusal
from waiting import LONG_S

ROUNDS = int(os.environ.get("ROUNDS", "1"))
"""How often each attack is made; `make soak` makes it often."""


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    with serving(tmp_path_factory.mktemp("attacked")) as running:
        yield running


@pytest.mark.parametrize("attack", ATTACKS, ids=lambda attack: attack.__name__)
def test_an_attack_is_refused_and_a_stop_meanwhile_takes_effect(server: RunningServer, attack: Attack) -> None:
    for _ in range(ROUNDS):
        server.put_back(pace=0.02)
        answers, statuses = stop_during(attack, server), ATTACKS[attack]
        assert answers <= statuses | {429} and bool(answers & statuses) == bool(statuses), answers
        server.client.put("/cells/yard/pace", json={"factor": None})
        assert server.process.poll() is None and server.client.get("/cells/yard").json()["state"] == "operational"


def stop_during(attack: Attack, server: RunningServer) -> set[int]:
    """Stop an operation while the server is attacked; return the statuses of the answers to the attacks."""
    operation = server.submit(task="carry_all")["id"]
    server.wait_for(operation, "running")
    attacker, stopped = make_attacker(server), threading.Event()

    def attack_until_it_is_stopped() -> list[int]:
        answers = attack(attacker)
        while not stopped.is_set():
            answers += attack(attacker)
        return answers

    with ThreadPoolExecutor() as pool:
        attacking = pool.submit(attack_until_it_is_stopped)
        try:
            time.sleep(0.5)
            assert server.client.get(f"/operations/{operation}").json()["state"] == "running"
            assert server.client.post(f"/operations/{operation}/stop", json={}).status_code == 200
            assert server.wait_for(operation, "stopped")["reason"] == "admin: stopped"
        finally:
            stopped.set()
        return set(attacking.result())


def test_no_entry_of_the_audit_log_has_more_than_a_line(server: RunningServer) -> None:
    forge_entries(server)
    actions = [each["action"] for each in server.client.get("/audit", params={"limit": 10_000}).json()]
    assert actions[-1].startswith("POST /api/v1/cells/x") and all(each.isprintable() for each in actions)


@pytest.mark.parametrize(
    "hello", ["", "[]", '{"token": 1}', '{"token": "wrong"}', '{"token": "x", "after": -1}', "[" * 1000, "x" * 100_000]
)
def test_a_websocket_without_a_token_is_closed(server: RunningServer, hello: str) -> None:
    async def greet() -> int:
        async with connect(f"{server.url.replace('http', 'ws')}/events") as client:
            await client.send(hello)
            with pytest.raises(ConnectionClosed) as closed:
                await client.recv()
        assert closed.value.rcvd is not None
        return closed.value.rcvd.code

    assert asyncio.run(greet()) in (1008, 1009)


def test_a_page_from_elsewhere_opens_no_websocket(server: RunningServer) -> None:
    async def greet() -> None:
        async with connect(f"{server.url.replace('http', 'ws')}/events", origin="http://evil.example"):  # type: ignore[arg-type]
            pass

    with pytest.raises(InvalidStatus, match="403"):
        asyncio.run(greet())


def test_a_websocket_that_says_something_later_is_closed_and_others_go_on(server: RunningServer) -> None:
    async def talk() -> None:
        async with connect(f"{server.url.replace('http', 'ws')}/events") as client:
            await client.send(json.dumps({"token": server.token}))
            await client.recv()
            await client.send("more")
            with pytest.raises(ConnectionClosed):
                while True:
                    await client.recv()

    asyncio.run(talk())
    assert server.client.get("/cells/yard").status_code == 200


def test_a_token_that_is_revoked_watches_no_longer(server: RunningServer) -> None:
    token = server.client.post("/tokens", json={"name": "leaver", "role": "view"}).json()["token"]

    async def watch() -> tuple[int, str]:
        async with connect(f"{server.url.replace('http', 'ws')}/events") as client:
            await client.send(json.dumps({"token": token}))
            await client.recv()
            assert server.client.delete("/tokens/leaver").status_code == 204
            server.client.put("/cells/yard/pace", json={"factor": 7.0})
            with pytest.raises(ConnectionClosed) as closed:
                await asyncio.wait_for(client.recv(), LONG_S)
        assert closed.value.rcvd is not None
        return closed.value.rcvd.code, closed.value.rcvd.reason

    assert asyncio.run(watch()) == (1008, "the token is not valid")


def test_more_websockets_than_are_taken_keep_no_request_out(server: RunningServer) -> None:
    async def crowd() -> None:
        async with AsyncExitStack() as stack:
            address = f"{server.url.replace('http', 'ws')}/events"
            found = [await stack.enter_async_context(connect(address)) for _ in range(MAX_UNKNOWN + 5)]
            with pytest.raises(ConnectionClosed) as closed:
                await asyncio.wait_for(found[-1].recv(), 20.0)
            assert closed.value.rcvd is not None and closed.value.rcvd.code == 1013
            assert server.client.get("/cells/yard").status_code == 200

    asyncio.run(crowd())


def test_a_body_that_does_not_arrive_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(requests, "BODY_S", 0.2)

    async def answer(request: Request) -> Response:
        try:
            return PlainTextResponse(await requests.read_body(request))
        except ApiRefusal as refused:
            return PlainTextResponse(refused.problem.detail, refused.status)

    app = Starlette(routes=[Route("/", answer, methods=["POST"])])
    with serving_app(uvicorn.Config(app, log_config=None, lifespan="off")) as port:
        with socket.create_connection(("127.0.0.1", port), 20.0) as slow:
            slow.sendall(b"POST / HTTP/1.1\r\nHost: a\r\nContent-Type: application/json\r\nContent-Length: 9\r\n\r\n{")
            assert slow.recv(4096).startswith(b"HTTP/1.1 408")
        assert httpx.post(f"http://127.0.0.1:{port}/", json=1).text == "1"
