"""Sessions of browsers: a code or a token begins one, its cookie stands for the token, and no other page can use it."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import httpx
import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from server.running import RunningServer
from skillc.cells.database import open_for_writing
from skillc.server.access import codes, sessions
from skillc.server.access.codes import LoginCodes
from skillc.server.access.sessions import Sessions
from skillc.server.access.tokens import Client, Tokens
from skillc.server.state import SCHEMA
from waiting import LONG_S

FORM = {"Content-Type": "application/x-www-form-urlencoded"}


def test_a_code_stands_for_its_token_once_and_for_a_minute() -> None:
    now = [100.0]
    login = LoginCodes(lambda: now[0])
    used, late = login.make(b"ada"), login.make(b"ada")
    assert (login.take(used), login.take(used), login.take("x")) == (b"ada", None, None)
    now[0] += 60.0
    assert login.take(late) is None


def test_the_oldest_codes_are_forgotten(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(codes, "MAX_CODES", 3)
    login = LoginCodes()
    made = [login.make(b"ada") for _ in range(5)]
    assert [login.take(each) for each in made] == [None, None, b"ada", b"ada", b"ada"]


def test_a_session_ends_with_its_time_its_token_and_the_newer_ones(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    now_ns = [10**18]
    monkeypatch.setattr(sessions.time, "time_ns", lambda: now_ns[0])
    monkeypatch.setattr(sessions, "MAX_OF_TOKEN", 2)
    with closing(open_for_writing(tmp_path / "database", SCHEMA)) as database:
        kept, tokens = Sessions(database), Tokens(database)
        ada, eve = (find_client(tokens, each) for each in ("ada", "eve"))
        first = kept.begin(ada.token)
        assert kept.find(first) == ada and kept.find("x") is None
        now_ns[0] += 1
        second, third, other = kept.begin(ada.token), kept.begin(ada.token), kept.begin(eve.token)
        assert [kept.find(each) for each in (first, second, third, other)] == [None, ada, ada, eve]
        kept.end(second)
        tokens.revoke("eve")
        find_client(tokens, "eve")
        assert [kept.find(each) for each in (second, third, other)] == [None, ada, None], "that is another token"
        now_ns[0] += sessions.LIFETIME_S * 10**9
        assert kept.find(third) is None
        kept.begin(ada.token)
        assert database.execute("SELECT count(*) FROM sessions").fetchone() == (1,)


def find_client(tokens: Tokens, name: str) -> Client:
    client = tokens.find(tokens.add(name, "view"))
    assert client is not None
    return client


@contextmanager
def logged_in(server: RunningServer, token: str) -> Iterator[httpx.Client]:
    """Return a browser, in which somebody has logged in with a code that a client with this token has made."""
    with server.client_of(token) as client:
        code = client.post("/login-codes").json()["code"]
    with httpx.Client(base_url=server.url, headers={"Origin": server.url.removesuffix("/api/v1")}) as browser:
        assert browser.post("/session", headers={"Authorization": f"Bearer {code}"}).status_code == 204
        assert browser.post("/session", headers={"Authorization": f"Bearer {code}"}).status_code == 401
        yield browser


@contextmanager
def token_of(server: RunningServer, role: str) -> Iterator[str]:
    """Return a token of a client `visitor`, which is revoked at the end."""
    made = server.client.post("/tokens", json={"name": "visitor", "role": role}).json()
    try:
        yield made["token"]
    finally:
        server.client.delete("/tokens/visitor")


def test_a_page_is_who_has_made_its_code(server: RunningServer) -> None:
    with token_of(server, "view") as token, logged_in(server, token) as browser:
        assert browser.get("/session").json() == {"name": "visitor", "role": "view"}
        assert browser.post("/cells/yard/stop", json={}).status_code == 200
        assert browser.post("/cells/yard/operations", json={"task": "carry_all"}).status_code == 403
        assert server.client.get("/session").json() == {"name": "admin", "role": "admin"}
        wrong = {"Authorization": "Bearer wrong"}
        assert browser.get("/session", headers=wrong).status_code == 401, "a token counts before a cookie"
        assert browser.delete("/session").status_code == 204 and not browser.cookies
        assert browser.get("/session").status_code == 401


def test_a_session_that_was_ended_ends_for_who_has_copied_its_cookie(server: RunningServer) -> None:
    with logged_in(server, server.token) as browser, httpx.Client(base_url=server.url) as thief:
        thief.cookies.update(browser.cookies)
        assert thief.get("/session").status_code == 200
        browser.delete("/session")
        assert thief.get("/session").status_code == 401


def test_no_script_reads_the_cookie_and_no_other_site_sends_it(server: RunningServer) -> None:
    answer = server.client.post("/session")
    name, _, attributes = answer.headers["set-cookie"].partition("=")
    assert name == f"skillc-{server.port}", "browsers have one set of cookies for all ports"
    assert {"HttpOnly", "SameSite=strict", "Path=/", "Max-Age=43200"} <= set(attributes.split("; "))
    secret = attributes.split(";")[0]
    found = [each.read_bytes() for each in (server.folder / "served").glob("server.sqlite*")]
    assert found and not any(secret.encode() in each for each in found), "it is kept as a hash"


def test_over_tls_a_cookie_is_never_sent_without(encrypted: RunningServer) -> None:
    with encrypted.client_of(encrypted.token) as browser:
        cookie = browser.post("/session").headers["set-cookie"]
        assert cookie.startswith(f"__Host-skillc-{encrypted.port}=") and "; Secure" in cookie
        del browser.headers["Authorization"]
        assert browser.get("/session").json() == {"name": "admin", "role": "admin"}


@pytest.mark.parametrize(
    ("method", "headers", "status"),
    [
        ("POST", {}, 403),
        ("POST", FORM, 403),
        ("POST", {"Origin": "http://evil.example"}, 403),
        ("POST", {"Origin": "null"}, 403),
        ("POST", {"Sec-Fetch-Site": "cross-site"}, 403),
        ("POST", {"Sec-Fetch-Site": "same-site", "Origin": "here"}, 403),
        ("POST", {"Origin": "here", **FORM}, 415),
        ("POST", {"Origin": "here"}, 200),
        ("POST", {"Sec-Fetch-Site": "same-origin"}, 200),
        ("GET", {"Sec-Fetch-Site": "cross-site"}, 403),
        ("GET", {"Sec-Fetch-Site": "same-site"}, 403),
        ("GET", {"Sec-Fetch-Site": "none"}, 200),
        ("GET", {}, 200),
    ],
)
def test_what_comes_with_a_cookie_comes_from_a_page_of_the_server(
    server: RunningServer, method: str, headers: dict[str, str], status: int
) -> None:
    here = server.url.removesuffix("/api/v1")
    headers = {"Content-Type": "application/json"} | {
        name: here if value == "here" else value for name, value in headers.items()
    }
    path = "/cells/yard/stop" if method == "POST" else "/cells/yard"
    with logged_in(server, server.token) as browser:
        del browser.headers["Origin"]
        content = None if method == "GET" else b"{}"
        answer = browser.request(method, path, headers=headers, content=content)
    assert answer.status_code == status, answer.text


def test_a_websocket_takes_the_cookie_of_a_page_of_the_server_until_its_token_is_revoked(server: RunningServer) -> None:
    here, address = server.url.removesuffix("/api/v1"), server.url.replace("http", "ws")

    async def watch(cookie: str) -> tuple[int, str]:
        headers = {"Cookie": cookie}
        async with connect(f"{address}/samples", origin=here, additional_headers=headers) as samples:  # type: ignore[arg-type]
            await samples.send('{"cell": "yard"}')
            assert isinstance(await samples.recv(), bytes)
        async with connect(f"{address}/events", origin=here, additional_headers=headers) as events:  # type: ignore[arg-type]
            await events.send("{}")
            assert json.loads(await events.recv())[0]["status"]["name"] == "yard"
            server.client.delete("/tokens/visitor")
            server.client.put("/cells/yard/pace", json={"factor": 7.0})
            with pytest.raises(ConnectionClosed) as closed:
                while True:
                    await asyncio.wait_for(events.recv(), LONG_S)
        assert closed.value.rcvd is not None
        return closed.value.rcvd.code, closed.value.rcvd.reason

    with token_of(server, "view") as token, logged_in(server, token) as browser:
        assert asyncio.run(watch(cookie_of(browser))) == (1008, "the token is not valid")
        assert browser.get("/session").status_code == 401


@pytest.mark.parametrize("path", ["/events", "/samples"])
def test_a_websocket_without_a_cookie_or_an_origin_is_closed(server: RunningServer, path: str) -> None:
    address, hello = server.url.replace("http", "ws") + path, '{"cell": "yard"}' if path == "/samples" else "{}"

    async def greet(headers: dict[str, str]) -> str:
        async with connect(address, additional_headers=headers) as client:
            await client.send(hello)
            with pytest.raises(ConnectionClosed) as closed:
                await client.recv()
        assert closed.value.rcvd is not None and closed.value.rcvd.code == 1008
        return closed.value.rcvd.reason

    async def come_from_elsewhere(headers: dict[str, str]) -> None:
        async with connect(address, origin="http://evil.example", additional_headers=headers):  # type: ignore[arg-type]
            pass

    assert asyncio.run(greet({})) == "the token is not valid"
    with logged_in(server, server.token) as browser:
        headers = {"Cookie": cookie_of(browser)}
        assert asyncio.run(greet(headers)) == "a WebSocket with a cookie needs an Origin"
        with pytest.raises(InvalidStatus, match="403"):
            asyncio.run(come_from_elsewhere(headers))


def cookie_of(browser: httpx.Client) -> str:
    ((name, value),) = browser.cookies.items()
    return f"{name}={value}"
