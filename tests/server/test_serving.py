"""A server keeps cells going: operations are submitted, commanded, stopped and remembered, whatever dies."""

from __future__ import annotations

import asyncio
import json
import os
import re
import signal
from pathlib import Path
from typing import cast

import httpx
import msgspec
import pytest
from click.testing import CliRunner
from starlette.routing import Route
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

from server.running import RunningServer, find_cell_process, serving, wait_until
from skillc.cli.main import skillc
from skillc.contract.access import ROLES
from skillc.contract.api.endpoint import PREFIX
from skillc.contract.api.endpoints import ENDPOINTS
from skillc.server.access.roles import includes
from skillc.server.app import Application
from skillc.server.context import ServerContext
from skillc.server.http.openapi import make_openapi
from waiting import LONG_S


def test_an_operation_is_paused_resumed_and_stopped(server: RunningServer) -> None:
    server.client.put("/cells/yard/pace", json={"factor": 0.1})
    operation = server.submit(task="carry_all")["id"]
    server.wait_for(operation, "running")
    assert server.client.post(f"/operations/{operation}/commands", json={"type": "pause"}).status_code == 200
    server.wait_for(operation, "paused")
    refused = server.client.post(f"/operations/{operation}/commands", json={"type": "pause"})
    assert refused.status_code == 409 and "resume" in refused.json()["allowed"]
    assert server.client.post(f"/operations/{operation}/commands", json={"type": "resume"}).status_code == 200
    assert server.client.post(f"/operations/{operation}/stop", json={"reason": "enough"}).status_code == 200
    assert server.wait_for(operation, "stopped")["reason"] == "admin: enough"
    assert server.client.post(f"/operations/{operation}/commands", json={"type": "pause"}).status_code == 409
    assert server.client.get("/cells/yard/operations").json()[0]["id"] == operation


def test_the_same_request_twice_is_one_operation(server: RunningServer) -> None:
    request, key = {"task": "carry_all", "approve": True}, {"Idempotency-Key": "once"}
    first, second = (server.client.post("/cells/yard/operations", json=request, headers=key) for _ in range(2))
    assert first.json()["id"] == second.json()["id"]
    other = server.client.post("/cells/yard/operations", json={"task": "carry_all"}, headers=key)
    assert other.status_code == 422 and "used for another request before" in other.json()["detail"]
    server.client.post("/cells/yard/stop", json={})
    server.wait_for(first.json()["id"], "stopped")


DOCUMENT = make_openapi(ENDPOINTS, PREFIX)
OPERATIONS = [(method.upper(), path) for path, methods in DOCUMENT["paths"].items() for method in methods]
OPEN_PATHS = {f"{PREFIX}/health", f"{PREFIX}/openapi.json"}
SOCKETS = {f"{PREFIX}/events", f"{PREFIX}/samples", f"{PREFIX}/lsp"}
"""What the document cannot describe; the tests of attacks, samples, sessions and languages have who may open them."""
OUTSIDE = {("GET", "/metrics"), ("GET", "/"), ("GET", "/assets/{path:path}")}
"""What is not below the prefix; test_network.py and test_studio_page.py have who may read it."""


@pytest.mark.parametrize(("method", "path"), OPERATIONS)
def test_each_operation_of_the_document_needs_its_role(server: RunningServer, method: str, path: str) -> None:
    security = DOCUMENT["paths"][path][method.lower()]["security"]
    url = f"{server.url.removesuffix(PREFIX)}{re.sub(r'{.*?}', 'none', path)}"
    if path in OPEN_PATHS:
        assert security == [] and httpx.request(method, url).status_code == 200
        return
    ((needed,),) = (each["token"] for each in security)
    for role in ROLES:
        name = f"{role}-{OPERATIONS.index((method, path))}"
        token = server.client.post("/tokens", json={"name": name, "role": role}).json()["token"]
        with server.client_of(token) as client:
            answer = client.request(method, url, json={})
        assert (answer.status_code == 403) == (not includes(role, needed)), (role, answer.text)
        assert server.client.delete(f"/tokens/{name}").status_code == 204
    with server.client_of(token, address="127.0.0.2") as client:
        refused = client.request(method, url, json={}).status_code
    assert refused in (401, 429), "a revoked token; many of them from one address in a short time are too many"


def test_each_route_is_in_the_document_that_is_served(server: RunningServer) -> None:
    assert server.client.get("/openapi.json").json() == json.loads(msgspec.json.encode(DOCUMENT))
    app = Application(cast(ServerContext, None), frozenset())
    routes = {(method, each.path) for each in app.routes if isinstance(each, Route) for method in each.methods or ()}
    others = {each.path for each in app.routes if not isinstance(each, Route)}
    unknown = {(method, path) for method, path in routes if method != "HEAD"} - {*OPERATIONS, *OUTSIDE}
    assert not unknown and others == SOCKETS


def test_a_token_that_does_not_exist_is_named(server: RunningServer) -> None:
    refused = server.client.delete("/tokens/ada")
    assert (refused.status_code, refused.json()["detail"]) == (404, "there is no token `ada`")


def test_pages_from_elsewhere_and_other_names_are_refused(server: RunningServer) -> None:
    assert server.client.get("/cells", headers={"Origin": "http://example.org"}).status_code == 403
    assert server.client.get("/cells", headers={"Host": "example.org"}).status_code == 421
    form = {"Content-Type": "application/x-www-form-urlencoded"}
    assert server.client.post("/cells/yard/stop", content="reason=x", headers=form).status_code == 415
    deep = b"[" * 100_000
    headers = {"Content-Type": "application/json"}
    assert server.client.post("/cells/yard/operations", content=deep, headers=headers).status_code in (400, 422)
    assert server.client.post("/cells/yard/operations", content=b" " * 2**21, headers=headers).status_code == 413


def test_the_events_of_an_operation_arrive_without_a_gap(server: RunningServer) -> None:
    server.client.put("/cells/yard/pace", json={"factor": None})
    operation = server.submit(task="carry_all")["id"]

    async def read(after: int) -> list[int]:
        found = list[int]()
        async with connect(f"{server.url.replace('http', 'ws')}/events") as socket:
            await socket.send(json.dumps({"token": server.token, "operation": operation, "after": after}))
            try:
                while True:
                    found += [each["sequence"] for each in json.loads(await socket.recv())]
            except ConnectionClosed as closed:
                assert closed.rcvd is not None and closed.rcvd.code == 1000, closed
        return found

    numbers = asyncio.run(read(0))
    ended = server.wait_for(operation, "succeeded")
    assert numbers == list(range(1, ended["events"] + 1)) and asyncio.run(read(5)) == numbers[5:]
    recorded = server.client.get(f"/operations/{operation}/events", params={"after": 3, "limit": 2}).json()
    assert [each["sequence"] for each in recorded] == [4, 5]


@pytest.mark.sim
def test_a_cell_that_dies_is_started_again_and_its_operation_was_interrupted(server: RunningServer) -> None:
    server.put_back(pace=0.1)
    operation = server.submit(task="carry_all")["id"]
    server.wait_for(operation, "running")
    os.kill(find_cell_process(server), signal.SIGKILL)
    wait_until(lambda: server.client.get("/cells/yard").json(), lambda it: "signal 9" in it["reason"])
    refused = server.client.post("/cells/yard/operations", json={"task": "carry_all"})
    assert refused.status_code == 503 and "yard is off" in refused.json()["detail"]
    server.wait_ready()
    left = server.client.get(f"/operations/{operation}").json()
    assert left["state"] == "interrupted" and left["decisions"][:2] == ["replan", "retry"]
    server.client.put("/cells/yard/pace", json={"factor": None})
    again = server.submit(continues=operation, decision="retry")["id"]
    server.wait_for(again, "succeeded")
    assert server.client.get(f"/operations/{operation}").json()["continued_by"] == again
    refused = server.client.post("/cells/yard/operations", json={"continues": operation})
    assert refused.status_code == 409 and f"was continued by {again}" in refused.json()["detail"]


@pytest.mark.sim
def test_a_killed_server_leaves_a_cell_at_rest_and_a_history(tmp_path: Path) -> None:
    with serving(tmp_path) as server:
        server.client.put("/cells/yard/pace", json={"factor": 0.1})
        operation = server.submit(task="carry_all")["id"]
        server.wait_for(operation, "running")
        cell = find_cell_process(server)
        server.process.kill()
        server.process.wait(LONG_S)
        wait_until(lambda: Path(f"/proc/{cell}").exists(), lambda there: not there)
    with serving(tmp_path) as again:
        found = again.client.get(f"/operations/{operation}").json()
        assert (found["state"], found["reason"]) == ("interrupted", "the server of the cell has ended")


def test_two_servers_cannot_share_a_state_folder(server: RunningServer) -> None:
    words = (server.folder, "--cell", server.folder / "yard.ttl", "--state", server.folder / "served")
    other = CliRunner().invoke(skillc, ["serve", *map(str, words), "--bind", "127.0.0.1:0"])
    assert other.exit_code == 1 and f"is in use by process {server.process.pid}" in other.output
