"""Who asks for too much, or sends too slowly, keeps no stop out; a server whose disk is full changes nothing."""

from __future__ import annotations

import asyncio
import resource
import socket
from contextlib import ExitStack
from pathlib import Path

import httpx
import pytest
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

from server.attacking import COSTLY
from server.running import RunningServer, serving
from server.test_network import bounded_server
from skillc.server import app
from skillc.server.app import Application
from skillc.server.context import FAILURES, ServerContext
from skillc.server.http import connections
from skillc.server.hub import EventHub
from skillc.server.state import open_state
from waiting import LONG_S

CARRY = {"task": "carry", "arguments": {"crate": "lab:crate-1", "to": "lab:Goal"}}
FLOOD = 12


def test_a_stop_takes_effect_while_costly_requests_still_wait(server: RunningServer) -> None:
    server.put_back(pace=0.02)
    operation = server.submit(task="carry_all")["id"]
    server.wait_for(operation, "running")

    async def flood() -> tuple[str, int, set[int]]:
        headers = {"Authorization": f"Bearer {server.token}"}
        async with httpx.AsyncClient(base_url=server.url, headers=headers, timeout=LONG_S) as client:
            asked = [
                asyncio.create_task(client.post("/cells/yard/operations", json={"goal": COSTLY})) for _ in range(FLOOD)
            ]
            await asyncio.sleep(0.3)
            await client.post(f"/operations/{operation}/stop", json={})
            state = ""
            while state not in ("stopped", "succeeded"):
                state = (await client.get(f"/operations/{operation}")).json()["state"]
            waiting = sum(not each.done() for each in asked)
            return state, waiting, {(await each).status_code for each in asked}

    state, waiting, statuses = asyncio.run(flood())
    assert state == "stopped" and waiting > FLOOD // 4, "the stop did not wait for them"
    assert statuses == {409}


def test_too_many_requests_of_a_client_are_refused_but_no_stop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(app, "REQUESTS_PER_S", 1e-3)
    monkeypatch.setattr(app, "BURST", 5.0)
    with open_state(tmp_path) as state:
        clients = [{"Authorization": f"Bearer {state.tokens.add(name, 'operate')}"} for name in ("busy", "calm")]
        served = Application(ServerContext(state, {}, EventHub()), frozenset({"here"}))

        async def ask() -> tuple[list[httpx.Response], httpx.Response, httpx.Response]:
            transport = httpx.ASGITransport(served.asgi)
            async with httpx.AsyncClient(transport=transport, base_url="http://here/api/v1") as client:
                answers = [await client.get("/cells", headers=clients[0]) for _ in range(8)]
                stop = await client.post("/operations/none/stop", headers=clients[0])
                return answers, stop, await client.get("/cells", headers=clients[1])

        answers, stop, other = asyncio.run(ask())
    assert [each.status_code for each in answers] == 5 * [200] + 3 * [429]
    assert {each.headers["Retry-After"] for each in answers[5:]} == {"1"}
    assert stop.status_code == 404 and other.status_code == 200


def test_bodies_that_do_not_arrive_keep_nobody_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "MAX_CONNECTIONS", 5)
    slow = b"POST / HTTP/1.1\r\nHost: a\r\nContent-Length: 50\r\n\r\n{"

    async def read(request: Request) -> Response:
        return PlainTextResponse(await request.body())

    with bounded_server(Starlette(routes=[Route("/", read, methods=["POST"])])) as port, ExitStack() as stack:
        for _ in range(20):
            stack.enter_context(socket.create_connection(("127.0.0.1", port))).sendall(slow)
        assert httpx.post(f"http://127.0.0.1:{port}/", content="whole").text == "whole"


def test_a_server_whose_disk_is_full_refuses_changes_and_stops_all_the_same(tmp_path: Path) -> None:
    with serving(tmp_path) as server:
        server.client.put("/cells/yard/pace", json={"factor": 0.02})
        operation = server.submit(task="carry_all")["id"]
        server.wait_for(operation, "running")
        unlimited = resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, (4096, resource.RLIM_INFINITY))
        before = server.client.get("/cells/yard/operations").json()
        refused = [
            server.client.post("/cells/yard/operations", json=CARRY),
            server.client.post("/cells/yard/operations", json=CARRY, headers={"Idempotency-Key": "a"}),
            server.client.post("/tokens", json={"name": "eve", "role": "view"}),
            server.client.post("/cells/yard/orders", json={"request": CARRY, "at": "2099-01-01T00:00:00Z"}),
        ]
        assert [each.status_code for each in refused] == [503] * len(refused)
        assert all("free some space" in each.json()["detail"] for each in refused)
        assert [each["id"] for each in server.client.get("/cells/yard/operations").json()] == [
            each["id"] for each in before
        ]
        assert httpx.get(f"{server.url}/cells").status_code == 401
        assert server.client.post(f"/operations/{operation}/stop", json={}).status_code == 200
        server.wait_for(operation, "stopped")
        resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, unlimited)
        assert server.submit(**CARRY)["state"] in ("queued", "planning", "running")


@pytest.mark.parametrize(("path", "origin"), [("/events", "127.0.0.31"), ("/samples", "127.0.0.32")])
def test_tokens_are_not_guessed_by_websocket(server: RunningServer, path: str, origin: str) -> None:
    hello = '{"cell": "yard", "token": "wrong"}' if path == "/samples" else '{"token": "wrong"}'

    async def guess(address: str) -> int:
        async with connect(address, local_addr=(origin, 0)) as client:
            await client.send(hello)
            with pytest.raises(ConnectionClosed) as closed:
                await client.recv()
        assert closed.value.rcvd is not None
        return closed.value.rcvd.code

    address = server.url.replace("http", "ws") + path
    number = int(FAILURES) + 20
    codes = [asyncio.run(guess(address)) for _ in range(number)]
    entries = server.client.get("/audit", params={"limit": 10_000}).json()
    noted = [each for each in entries if (each["status"], each["origin"]) == (401, origin)]
    assert codes[:3] == [1008] * 3 and codes[-1] == 1013, "too many"
    assert int(FAILURES) <= len(noted) < number
    assert noted[0]["action"] == f"WebSocket /api/v1{path}"
