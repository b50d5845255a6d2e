"""Finds out who makes a request or opens a WebSocket: by a token, a one-time code, or the cookie of a session."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from http import HTTPStatus

from starlette.requests import HTTPConnection
from starlette.responses import Response

from skillc.server.access.sessions import LIFETIME_S
from skillc.server.access.tokens import Client
from skillc.server.context import ServerContext
from skillc.server.problems import ApiRefusal

SAFE = ("GET", "HEAD")


@dataclass(frozen=True, slots=True)
class SessionCookie:
    """The cookie of a session on a connection.

    Browsers have one set of cookies for all ports of a host, so the name has that of the server. Over TLS no other host
    and no unencrypted page can set it (`__Host-`).
    """

    name: str
    secure: bool

    def set(self, response: Response, secret: str) -> None:
        """Let a browser keep the secret of a session, and no script read it."""
        response.set_cookie(
            self.name, secret, max_age=LIFETIME_S, path="/", secure=self.secure, httponly=True, samesite="strict"
        )

    def remove(self, response: Response) -> None:
        """Let a browser forget the secret of a session."""
        response.delete_cookie(self.name, path="/", secure=self.secure, httponly=True, samesite="strict")


def find_cookie(connection: HTTPConnection) -> SessionCookie:
    """Return the cookie of sessions on a connection."""
    _, port = connection.scope.get("server") or ("", 0)
    secure = connection.scope.get("scheme") in ("https", "wss")
    return SessionCookie(f"{'__Host-' if secure else ''}skillc-{port}", secure)


def read_session(connection: HTTPConnection) -> str | None:
    """Return the secret in the cookie of a connection; None without one."""
    return connection.cookies.get(find_cookie(connection).name)


def find_client(server: ServerContext, connection: HTTPConnection) -> Client | None:
    """Return who makes a request, by its `Authorization: Bearer` header or its cookie; None without a valid one.

    A one-time code in the header is used up. ApiRefusal (403) if a cookie comes with a request that no page of this
    server has made.
    """
    authorization = connection.headers.get("authorization")
    if authorization is None:
        secret = read_session(connection)
        client = server.state.sessions.find(secret) if secret is not None else None
        if client is not None:
            _check_page(connection)
        return client
    scheme, _, text = authorization.partition(" ")
    if scheme.lower() != "bearer" or not text.isascii():
        return None
    return server.state.tokens.find(text.strip()) or _use_code(server, text.strip())


def find_known_client(server: ServerContext, connection: HTTPConnection) -> Client:
    """Return who makes a request; ApiRefusal (401, 429) without a valid token or session, 403 as of `find_client`."""
    client = find_client(server, connection)
    if client is None:
        raise refuse_unknown(server, connection, "send a token: `Authorization: Bearer TOKEN`")
    return client


def refuse_unknown(server: ServerContext, connection: HTTPConnection, why: str) -> ApiRefusal:
    """Return how a request or a WebSocket without a valid token is refused; an address may make only so many."""
    if not server.failures.take(connection.client.host if connection.client else ""):
        return ApiRefusal(HTTPStatus.TOO_MANY_REQUESTS, "too many requests without a valid token")
    return ApiRefusal(HTTPStatus.UNAUTHORIZED, why)


def make_credential(
    server: ServerContext, connection: HTTPConnection, token: str | None
) -> Callable[[], Client | None]:
    """Return what says who opens a WebSocket, as long as that is valid: a token, or without one the cookie.

    ApiRefusal (403) if a cookie comes with a WebSocket that no page of this server has opened.
    """
    if token is not None:
        return partial(server.state.tokens.find, token)
    secret = read_session(connection)
    if secret is None:
        return lambda: None
    if "origin" not in connection.headers:
        raise ApiRefusal(HTTPStatus.FORBIDDEN, "a WebSocket with a cookie needs an Origin")
    return partial(server.state.sessions.find, secret)


def _use_code(server: ServerContext, code: str) -> Client | None:
    token = server.codes.take(code)
    return server.state.tokens.find_hash(token) if token is not None else None


def _check_page(connection: HTTPConnection) -> None:
    """Raise ApiRefusal (403) unless a page of this server has made a request that has a cookie.

    Pages of other ports are of the same site, so their requests have the cookie, too. `Guard` has refused an `Origin`
    other than this server; what changes something must have one, or say by `Sec-Fetch-Site` that its page is from here.
    """
    site = connection.headers.get("sec-fetch-site")
    if site not in (None, "same-origin", "none"):
        raise ApiRefusal(HTTPStatus.FORBIDDEN, "requests of pages from elsewhere are refused")
    known = "origin" in connection.headers or site == "same-origin"
    if connection.scope["method"] not in SAFE and not known:
        raise ApiRefusal(HTTPStatus.FORBIDDEN, "a request with a cookie that changes something needs an Origin")
