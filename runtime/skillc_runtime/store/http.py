"""The SPARQL 1.1 protocol over HTTP: one query or update at a time, on a connection that stays open."""

from __future__ import annotations

import http.client
import ssl
from dataclasses import dataclass
from typing import Any, Protocol

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.store.address import Address, without_credentials
from skillc_runtime.store.timed_socket import TimedSocket
from skillc_runtime.world.state.transactions import StoreError

TIMEOUT_S = 10.0
"""The timeout for the connection and for each part of an answer."""
TOTAL_TIMEOUTS = 6
"""The time for a whole answer, as a multiple of the timeout."""
MAX_ANSWER_BYTES = 2**30
"""The limit for an answer; enough for a world of some million facts."""
FORMS = (("", ""), ("/query", "/update"), ("", "/statements"), ("/sparql", "/update"))
"""Paths for queries and updates below the address of a server: Fuseki and Virtuoso, Oxigraph, RDF4J, others."""
EMPTY_QUERY, EMPTY_UPDATE = "ASK {}", "INSERT DATA {}"
ROWS = "application/sparql-results+json"
QUERY, UPDATE = "application/sparql-query", "application/sparql-update"
LONGEST_REASON = 200
"""The maximum number of characters of the server's message that are shown."""


class ServerUnreachable(StoreError):
    """A server did not answer properly; whether it executed the request is not known."""


class InvalidAnswer(ServerUnreachable):
    """A server answered with something that is not a valid answer."""


class RequestRefused(StoreError):
    """A server rejected a request; `status` is the HTTP status."""

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message)
        self.status = status


class SparqlEndpoint(Protocol):
    """Answers SPARQL queries and executes updates, each completely or not at all."""

    def query(self, text: str, accept: str) -> bytes:
        """Return an answer in the media type `accept`; ServerUnreachable, RequestRefused."""

    def update(self, text: str) -> None:
        """Execute an update; ServerUnreachable, RequestRefused."""

    def close(self) -> None:
        """Close the connection."""


@dataclass(frozen=True, slots=True)
class _Answer:
    status: int
    reason: str
    kind: str
    body: bytes
    location: str


class _TooLarge(Exception):
    """An answer with more than MAX_ANSWER_BYTES."""


class HttpEndpoint:
    """A SPARQL server with one address for queries and one for updates, `http://` or `https://`.

    `user:password@` before the host is sent as basic authentication. As text it is its address without credentials.
    """

    def __init__(
        self, address: str, query: str, update: str, timeout_s: float = TIMEOUT_S, cancel: CancelToken | None = None
    ) -> None:
        """Use the server at an address; `query` and `update` are the paths below it.

        `timeout_s` is the longest wait for a part of an answer in s; a whole answer may take TOTAL_TIMEOUTS times that.
        `cancel` ends all waits.
        """
        self._address, self._timeout_s, self._cancel = Address.parse(address), timeout_s, cancel or CancelToken()
        self._query, self._update = self._address.append_path(query), self._address.append_path(update)
        self._connection: http.client.HTTPConnection | None = None

    def __str__(self) -> str:
        return str(self._address)

    def query(self, text: str, accept: str) -> bytes:
        """Return an answer in the media type `accept`; ServerUnreachable, RequestRefused."""
        answer = self._post(self._query, QUERY, text, accept)
        if not answer.kind.startswith(accept):
            raise InvalidAnswer(f"{self} answers with {answer.kind or 'something'} where {accept} was requested")
        return answer.body

    def update(self, text: str) -> None:
        """Execute an update; ServerUnreachable, RequestRefused."""
        self._post(self._update, UPDATE, text, "*/*")

    def close(self) -> None:
        """Close the connection."""
        if self._connection is not None:
            self._connection.close()
            self._connection = None

    def _post(self, url: Address, kind: str, text: str, accept: str) -> _Answer:
        """Send a text; a connection that the server closed in the meantime is opened again."""
        reused = self._connection is not None
        try:
            answer = self._exchange(url, kind, text, accept)
        except _TooLarge:
            self.close()
            raise InvalidAnswer(
                f"{url} answers with more than {MAX_ANSWER_BYTES >> 20} MB, which is too much for a world"
            ) from None
        except (OSError, http.client.HTTPException) as error:
            self.close()
            if reused and isinstance(error, ConnectionError):
                return self._post(url, kind, text, accept)
            raise ServerUnreachable(
                f"{url} does not answer: {url.without_secrets(_describe_failure(error, self._timeout_s))}"
            ) from None
        if answer.status < 300:
            return answer
        raise _refusal(url, answer)

    def _exchange(self, url: Address, kind: str, text: str, accept: str) -> _Answer:
        cancel = self._cancel.limited(TOTAL_TIMEOUTS * self._timeout_s)
        connection = self._connection = self._connection or _connection(url, self._timeout_s)
        timed: Any = connection.sock
        if timed is None:
            connection.connect()
            connection.sock = timed = TimedSocket(connection.sock, self._timeout_s, cancel)
        timed.cancel = cancel
        headers = {"Content-Type": f"{kind}; charset=utf-8", "Accept": accept, **url.authorization()}
        connection.request("POST", url.target, text.encode(), headers)
        response = connection.getresponse()
        content = response.headers.get_content_type() if "Content-Type" in response.headers else ""
        location = without_credentials(response.headers.get("Location", ""))
        return _Answer(response.status, response.reason, content, _body(response), location)


def find_endpoint(address: str, timeout_s: float = TIMEOUT_S, cancel: CancelToken | None = None) -> HttpEndpoint:
    """Return the endpoint at an address that answers queries and updates; StoreError when there is none.

    The SPARQL standard does not fix the paths, so the common ones are tried.
    """
    name = Address.parse(address)
    refusals: list[StoreError] = []
    for query, update in FORMS:
        endpoint = HttpEndpoint(address, query, update, timeout_s, cancel)
        try:
            endpoint.query(EMPTY_QUERY, ROWS)
            endpoint.update(EMPTY_UPDATE)
        except (RequestRefused, InvalidAnswer) as error:
            refusals.append(error)
        else:
            return endpoint
        endpoint.close()
    raise StoreError(f"no SPARQL 1.1 server accepts queries and updates at {name}: {refusals[-1]}")


def _body(response: http.client.HTTPResponse) -> bytes:
    parts, size = list[bytes](), 0
    while part := response.read(2**20):
        parts.append(part)
        size += len(part)
        if size > MAX_ANSWER_BYTES:
            raise _TooLarge
    if response.length:
        raise http.client.IncompleteRead(b"", response.length)
    return b"".join(parts)


def _refusal(url: Address, answer: _Answer) -> StoreError:
    """Return the error for an answer with an error status, with the server's message."""
    text = " ".join(answer.body.decode("utf-8", "replace").split())
    text = url.without_secrets("".join(each for each in text if each.isprintable()))[:LONGEST_REASON]
    reason = url.without_secrets(answer.reason)
    message = f"{url} answers {answer.status} {reason}" + (f": {text}" if text else "")
    if answer.status < 400:
        where = url.without_secrets(answer.location) or "another address"
        return RequestRefused(
            f"{url} answers {answer.status} {reason}: it redirects to {where}; use that address", answer.status
        )
    return (
        ServerUnreachable(message)
        if answer.status >= 500 and answer.status != 501
        else RequestRefused(message, answer.status)
    )


def _connection(url: Address, timeout_s: float) -> http.client.HTTPConnection:
    if url.is_encrypted:
        context = ssl.create_default_context()
        return http.client.HTTPSConnection(url.host, url.port, timeout=timeout_s, context=context)
    return http.client.HTTPConnection(url.host, url.port, timeout=timeout_s)


def _describe_failure(error: Exception, timeout_s: float) -> str:
    match error:
        case TimeoutError():
            return f"no answer within {timeout_s:g} s, or not a complete one within {TOTAL_TIMEOUTS * timeout_s:g} s"
        case ConnectionRefusedError():
            return "no server is listening there"
        case ConnectionError() | http.client.RemoteDisconnected():
            return "the connection was lost"
        case http.client.HTTPException():
            return "it does not speak HTTP"
        case _:
            return getattr(error, "strerror", None) or str(error)
