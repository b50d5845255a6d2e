"""Who attacks a server is refused with a status, and neither disturbs an operation nor keeps a stop from it."""

from __future__ import annotations

import asyncio
import json
import socket
from collections.abc import Callable, Iterator
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

from server.running import RunningServer, serving, serving_app
from skillc.server import requests
from skillc.server.problems import ApiRefusal
from skillc.server.watchers import MAX_UNKNOWN

JSON = {"Content-Type": "application/json"}
Attack = Callable[[RunningServer], list[int]]
"""Attacks a server; returns the statuses of its answers."""


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    with serving(tmp_path_factory.mktemp("attacked")) as running:
        yield running


def send(server: RunningServer, content: bytes) -> int:
    """Send bytes over a connection of its own; return the status of the answer, 0 if the connection is just closed."""
    with socket.create_connection(("127.0.0.1", server.port), 20.0) as connection:
        connection.sendall(content)
        answer = connection.recv(4096)
    return int(answer.split(b" ")[1]) if answer else 0


def submit(server: RunningServer, **request: object) -> int:
    return server.client.post("/cells/yard/operations", json=request).status_code


def rebind_name(server: RunningServer) -> list[int]:
    hosts = ("evil.example:80", f"evil.example:{server.port}", "127.0.0.1.evil.example", "")
    return [server.client.get("/cells", headers={"Host": each}).status_code for each in hosts]


def come_from_another_page(server: RunningServer) -> list[int]:
    origins = ("https://evil.example", "null", f"http://127.0.0.1:{server.port + 1}", "file://")
    return [server.client.post("/cells/yard/stop", json={}, headers={"Origin": each}).status_code for each in origins]


def submit_a_form(server: RunningServer) -> list[int]:
    kinds = ("application/x-www-form-urlencoded", "text/plain", "multipart/form-data; boundary=x", "")
    content = b'{"task": "carry_all"}'
    return [
        server.client.post("/cells/yard/operations", content=content, headers={"Content-Type": each}).status_code
        for each in kinds
    ]


def leave_the_folder(server: RunningServer) -> list[int]:
    names = ("..%2F..%2Fetc%2Fpasswd", "%2e%2e", "yard%00", "..\\..\\secret", "%2Fetc%2Fpasswd")
    paths = [f"/{kind}/{name}" for kind in ("cells", "operations") for name in names]
    return [
        *(server.client.get(each).status_code for each in paths),
        *(submit(server, task="carry_all", breakpoints=[each]) for each in ("../../etc/passwd:1", "/etc/passwd:1")),
    ]


def send_too_much(server: RunningServer) -> list[int]:
    deep = [b"[" * 100_000, b'{"arguments":' * 50_000, b'{"task": "' + b"a" * 2_000_000]
    path = "/cells/yard/operations"
    return [
        *(server.client.post(path, content=each, headers=JSON).status_code for each in deep),
        submit(server, task="carry_all", arguments={f"name{number}": "lab:Goal" for number in range(10_000)}),
        submit(server, goal="(" * 100_000),
        submit(server, goal="not " * 100_000 + "lab:Goal contain lab:crate-0"),
        submit(server, call="Load(" * 10_000),
    ]


def smuggle(server: RunningServer) -> list[int]:
    head = f"POST /api/v1/cells/yard/stop HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n".encode()
    return [
        send(server, head + b"Content-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\nGET /x"),
        send(server, head + b"Content-Length: 5\r\nContent-Length: 6\r\n\r\n{}"),
        send(server, head + b"Transfer-Encoding: chunked, chunked\r\n\r\n0\r\n\r\n"),
        send(server, head + b"Host: evil.example\r\nContent-Length: 0\r\n\r\n"),
        send(server, head + b"X: a\r\n b\nEvil: x\r\nContent-Length: -1\r\n\r\n"),
        send(server, b"GET http://evil.example/api/v1/cells HTTP/1.1\r\nHost: evil.example\r\n\r\n"),
        send(server, b"GET / HTTP/1.1\r\n" + b"X: " + b"a" * 200_000 + b"\r\n\r\n"),
        send(server, b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\r\n\r\n"),
    ]


def guess_tokens(server: RunningServer) -> list[int]:
    guesses = [
        "x y",
        "skillc_",
        "admin",
        "\xff",
        "a" * 5000,
        server.token[:-1],
        server.token.upper(),
        *map(str, range(150)),
    ]
    return [
        httpx.get(f"{server.url}/cells", headers={"Authorization": f"Bearer {each}".encode("latin-1")}).status_code
        for each in guesses
    ]


def connect_again_and_again(server: RunningServer) -> list[int]:
    for _ in range(10_000):
        socket.create_connection(("127.0.0.1", server.port), 20.0).close()
    return []


def forge_entries(server: RunningServer) -> list[int]:
    path = "/cells/x%0D%0A2026-01-01 admin GET 200%1B[2J/stop"
    return [server.client.post(path, json={}).status_code]


@pytest.mark.parametrize(
    ("attack", "statuses"),
    [
        (rebind_name, {421, 400}),
        (come_from_another_page, {403}),
        (submit_a_form, {415}),
        (leave_the_folder, {404, 409}),
        (send_too_much, {400, 409, 413, 422}),
        (smuggle, {0, 400, 401, 421, 431}),
        (guess_tokens, {401, 429}),
        (connect_again_and_again, set[int]()),
        (forge_entries, {404}),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_an_attack_is_refused_and_disturbs_nothing(server: RunningServer, attack: Attack, statuses: set[int]) -> None:
    server.client.put("/cells/yard/pace", json={"factor": 0.02})
    operation = server.submit(task="carry_all")["id"]
    server.wait_for(operation, "running")
    answers = attack(server)
    assert set(answers) <= statuses and bool(answers) == bool(statuses), answers
    assert server.client.get(f"/operations/{operation}").json()["state"] == "running"
    server.client.post(f"/operations/{operation}/stop", json={})
    assert server.wait_for(operation, "stopped")["reason"] == "admin: stopped"
    server.client.put("/cells/yard/pace", json={"factor": None})
    assert server.process.poll() is None and server.client.get("/cells/yard").json()["state"] == "operational"


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
                await asyncio.wait_for(client.recv(), 20.0)
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
