"""The SPARQL 1.1 protocol over HTTP: one query or one update at a time, on a connection that is kept."""

from __future__ import annotations

import base64
import http.client
import ssl
from dataclasses import dataclass
from typing import Protocol
from urllib.parse import SplitResult, unquote, urlsplit

from skillc_runtime.world.store.store import StoreError

TIMEOUT_S = 10.0
QUERY, UPDATE = "application/sparql-query", "application/sparql-update"
LONGEST_REASON = 200
"""How many characters of a server's own message are shown."""


class Unreachable(StoreError):
    """A server that did not answer, or not as one does; whether it did what it was asked for is not known."""


class Garbled(Unreachable):
    """A server that answered with something that is no answer."""


class Refused(StoreError):
    """A server that answered that it does not do what it was asked for; `status` is the HTTP status."""

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message)
        self.status = status


class Endpoint(Protocol):
    """Answers SPARQL queries and makes updates, each of them whole or not at all."""

    def query(self, text: str, accept: str) -> bytes:
        """Return an answer in the media type `accept`; Unreachable, Refused."""

    def update(self, text: str) -> None:
        """Make an update; Unreachable, Refused."""

    def close(self) -> None:
        """End what is kept open."""


@dataclass(frozen=True, slots=True)
class _Answer:
    status: int
    reason: str
    kind: str
    body: bytes


class HttpEndpoint:
    """A SPARQL server with one address for queries and one for updates, `http://` or `https://`.

    `user:password@` before the host is sent as basic authentication.
    """

    def __init__(self, address: str, query: str, update: str, timeout_s: float = TIMEOUT_S) -> None:
        """Use the server at an address; `query` and `update` are what follows it for each, TIMEOUT_S for one answer."""
        base = address.rstrip("/")
        self._address, self._timeout_s = urlsplit(address), timeout_s
        self._query, self._update = urlsplit(base + query), urlsplit(base + update)
        self._connection: http.client.HTTPConnection | None = None

    def __str__(self) -> str:
        return _shown(self._address)

    def query(self, text: str, accept: str) -> bytes:
        """Return an answer in the media type `accept`; Unreachable, Refused."""
        answer = self._post(self._query, QUERY, text, accept)
        if not answer.kind.startswith(accept):
            raise Garbled(f"{self} answers with {answer.kind or 'something'} where {accept} was asked for")
        return answer.body

    def update(self, text: str) -> None:
        """Make an update; Unreachable, Refused."""
        self._post(self._update, UPDATE, text, "*/*")

    def close(self) -> None:
        """End the connection."""
        if self._connection is not None:
            self._connection.close()
            self._connection = None

    def _post(self, url: SplitResult, kind: str, text: str, accept: str) -> _Answer:
        """Send a text; a connection that was kept and that the server closed in the meantime is opened again."""
        kept = self._connection is not None
        try:
            answer = self._exchange(url, kind, text, accept)
        except (OSError, http.client.HTTPException) as error:
            self.close()
            if kept and isinstance(error, ConnectionError):
                return self._post(url, kind, text, accept)
            raise Unreachable(f"{_shown(url)} does not answer: {_why(error, self._timeout_s)}") from error
        if answer.status < 300:
            return answer
        told = " ".join(answer.body.decode("utf-8", "replace").split())[:LONGEST_REASON]
        message = f"{_shown(url)} answers {answer.status} {answer.reason}" + (f": {told}" if told else "")
        raise Unreachable(message) if answer.status >= 500 and answer.status != 501 else Refused(message, answer.status)

    def _exchange(self, url: SplitResult, kind: str, text: str, accept: str) -> _Answer:
        connection = self._connection = self._connection or _connection(url, self._timeout_s)
        target = (url.path or "/") + (f"?{url.query}" if url.query else "")
        headers = {"Content-Type": f"{kind}; charset=utf-8", "Accept": accept, **_authorization(url)}
        connection.request("POST", target, text.encode(), headers)
        response = connection.getresponse()
        content = response.headers.get_content_type() if "Content-Type" in response.headers else ""
        return _Answer(response.status, response.reason, content, response.read())


def _connection(url: SplitResult, timeout_s: float) -> http.client.HTTPConnection:
    host = url.hostname or ""
    if url.scheme == "https":
        return http.client.HTTPSConnection(host, url.port, timeout=timeout_s, context=ssl.create_default_context())
    return http.client.HTTPConnection(host, url.port, timeout=timeout_s)


def _authorization(url: SplitResult) -> dict[str, str]:
    if url.username is None:
        return {}
    pair = f"{unquote(url.username)}:{unquote(url.password or '')}"
    return {"Authorization": f"Basic {base64.b64encode(pair.encode()).decode()}"}


def _shown(url: SplitResult) -> str:
    """Return an address without its password."""
    return url._replace(netloc=url.netloc.rpartition("@")[2]).geturl()


def _why(error: Exception, timeout_s: float) -> str:
    match error:
        case TimeoutError():
            return f"no answer within {timeout_s:g} s"
        case ConnectionRefusedError():
            return "nobody listens there"
        case ConnectionError() | http.client.RemoteDisconnected():
            return "the connection broke"
        case http.client.HTTPException():
            return "that is no HTTP"
        case _:
            return getattr(error, "strerror", None) or str(error)
