"""Attacks on a server that runs, each of which it has to refuse; tests and benchmarks make them."""

from __future__ import annotations

import socket
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from copy import copy
from types import MappingProxyType

import httpx

from server.running import RunningServer

JSON = {"Content-Type": "application/json"}
COSTLY = " and ".join(["lab:Goal contain lab:crate-0"] * 1500 + ["lab:Goal contain lab:nothing"])
"""A goal that takes half a second to read."""
ENDLESS = 'SELECT * { ?a ?b ?c . ?d ?e ?f . ?g ?h ?i . FILTER(STR(?c) = CONCAT(STR(?f), STR(?i), "x")) }'
Attack = Callable[[RunningServer], list[int]]
"""Attacks a server; returns the statuses of its answers."""


def make_attacker(server: RunningServer) -> RunningServer:
    """Return a server as an attacker sees it who has a token of an administrator, and so a rate of his own."""
    name = f"attacker-{time.time_ns()}"
    attacker = copy(server)
    attacker.token = server.client.post("/tokens", json={"name": name, "role": "admin"}).json()["token"]
    attacker.client = server.client_of(attacker.token)
    return attacker


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


def query_what_is_forbidden(server: RunningServer) -> list[int]:
    foreign = "SELECT * { SERVICE <http://evil.example/> { ?a ?b ?c } }"
    path = "/cells/yard/world/query"
    queries = ("LOAD <file:///etc/passwd>", foreign, "DELETE WHERE { ?a ?b ?c }")
    return [server.client.post(path, json={"sparql": each}).status_code for each in queries]


def query_without_end(server: RunningServer) -> list[int]:
    return [server.client.post("/cells/yard/world/query", json={"sparql": ENDLESS}).status_code]


def send_slowly(server: RunningServer) -> list[int]:
    head = f"POST /api/v1/cells/yard/operations HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n"
    head += f"Authorization: Bearer {server.token}\r\nContent-Type: application/json\r\nContent-Length: 1000\r\n\r\n{{"
    with ExitStack() as stack:
        for _ in range(50):
            connection = stack.enter_context(socket.create_connection(("127.0.0.1", server.port), 20.0))
            connection.sendall(head.encode())
        time.sleep(0.2)
    return []


def submit_costly_goals(server: RunningServer) -> list[int]:
    return [submit(server, goal=COSTLY) for _ in range(4)]


ATTACKS: Mapping[Attack, frozenset[int]] = MappingProxyType(
    {
        rebind_name: frozenset({421, 400}),
        come_from_another_page: frozenset({403}),
        submit_a_form: frozenset({415}),
        leave_the_folder: frozenset({404, 409}),
        send_too_much: frozenset({400, 409, 413, 422}),
        smuggle: frozenset({0, 400, 401, 421, 429, 431}),
        guess_tokens: frozenset({401, 429}),
        connect_again_and_again: frozenset(),
        forge_entries: frozenset({404}),
        query_what_is_forbidden: frozenset({422}),
        query_without_end: frozenset({503}),
        send_slowly: frozenset(),
        submit_costly_goals: frozenset({409}),
    }
)
"""Each attack with the statuses by which it may be refused; none where there is no request."""
