"""The SPARQL 1.1 protocol over HTTP: one query or one update at a time, on a connection that is kept."""

from __future__ import annotations

import http.client
import ssl
from dataclasses import dataclass
from typing import Any, Protocol

from skillc_runtime.store.address import Address, without_credentials
from skillc_runtime.store.deadline import Deadline, TimedSocket
from skillc_runtime.world.state.transactions import StoreError

TIMEOUT_S = 10.0
"""How long a server is waited for to take a connection, and then to send something."""
TOTAL_TIMEOUTS = 6
"""So many times that long a whole answer may take."""
MAX_ANSWER_BYTES = 2**30
"""The greatest number of bytes of an answer: a world of some million facts."""
QUERY, UPDATE = "application/sparql-query", "application/sparql-update"
LONGEST_REASON = 200
"""How many characters of a server's own message are shown."""


class ServerUnreachable(StoreError):
    """A server that did not answer, or not as one does; whether it did what it was asked for is not known."""


class InvalidAnswer(ServerUnreachable):
    """A server that answered with something that is no answer."""


class RequestRefused(StoreError):
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
    elsewhere: str


class _TooLarge(Exception):
    """An answer of more bytes than a world has."""


class HttpEndpoint:
    """A SPARQL server with one address for queries and one for updates, `http://` or `https://`.

    `user:password@` before the host is sent as basic authentication. As text it is its address without credentials.
    """

    def __init__(self, address: str, query: str, update: str, timeout_s: float = TIMEOUT_S) -> None:
        """Use the server at an address; `query` and `update` are what follows it for each.

        A server is waited for `timeout_s` to say something, and TOTAL times that long for a whole answer.
        """
        self._address, self._timeout_s = Address.parse(address), timeout_s
        self._query, self._update = self._address.append_path(query), self._address.append_path(update)
        self._connection: http.client.HTTPConnection | None = None

    def __str__(self) -> str:
        return str(self._address)

    def query(self, text: str, accept: str) -> bytes:
        """Return an answer in the media type `accept`; Unreachable, Refused."""
        answer = self._post(self._query, QUERY, text, accept)
        if not answer.kind.startswith(accept):
            raise InvalidAnswer(f"{self} answers with {answer.kind or 'something'} where {accept} was asked for")
        return answer.body

    def update(self, text: str) -> None:
        """Make an update; Unreachable, Refused."""
        self._post(self._update, UPDATE, text, "*/*")

    def close(self) -> None:
        """End the connection."""
        if self._connection is not None:
            self._connection.close()
            self._connection = None

    def _post(self, url: Address, kind: str, text: str, accept: str) -> _Answer:
        """Send a text; a connection that was kept and that the server closed in the meantime is opened again."""
        kept = self._connection is not None
        try:
            answer = self._exchange(url, kind, text, accept)
        except _TooLarge:
            self.close()
            raise InvalidAnswer(
                f"{url} answers with more than {MAX_ANSWER_BYTES >> 20} MB, which is no world"
            ) from None
        except (OSError, http.client.HTTPException) as error:
            self.close()
            if kept and isinstance(error, ConnectionError):
                return self._post(url, kind, text, accept)
            raise ServerUnreachable(
                f"{url} does not answer: {url.without_secrets(_describe_failure(error, self._timeout_s))}"
            ) from None
        if answer.status < 300:
            return answer
        raise _refusal(url, answer)

    def _exchange(self, url: Address, kind: str, text: str, accept: str) -> _Answer:
        deadline = Deadline(TOTAL_TIMEOUTS * self._timeout_s, self._timeout_s)
        connection = self._connection = self._connection or _connection(url, self._timeout_s)
        timed: Any = connection.sock
        if timed is None:
            connection.connect()
            connection.sock = timed = TimedSocket(connection.sock)
        timed.deadline = deadline
        headers = {"Content-Type": f"{kind}; charset=utf-8", "Accept": accept, **url.authorization()}
        connection.request("POST", url.target, text.encode(), headers)
        response = connection.getresponse()
        content = response.headers.get_content_type() if "Content-Type" in response.headers else ""
        elsewhere = without_credentials(response.headers.get("Location", ""))
        return _Answer(response.status, response.reason, content, _body(response), elsewhere)


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
    """Return what it means that a server does not do what it was asked for, with its own words."""
    told = " ".join(answer.body.decode("utf-8", "replace").split())
    told = url.without_secrets("".join(each for each in told if each.isprintable()))[:LONGEST_REASON]
    reason = url.without_secrets(answer.reason)
    message = f"{url} answers {answer.status} {reason}" + (f": {told}" if told else "")
    if answer.status < 400:
        where = url.without_secrets(answer.elsewhere) or "another address"
        return RequestRefused(
            f"{url} answers {answer.status} {reason}: it sends on to {where}; name that one", answer.status
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
            return f"no answer within {timeout_s:g} s, or not a whole one within {TOTAL_TIMEOUTS * timeout_s:g} s"
        case ConnectionRefusedError():
            return "nobody listens there"
        case ConnectionError() | http.client.RemoteDisconnected():
            return "the connection broke"
        case http.client.HTTPException():
            return "that is no HTTP"
        case _:
            return getattr(error, "strerror", None) or str(error)


FORMS = (("", ""), ("/query", "/update"), ("", "/statements"), ("/sparql", "/update"))
"""What servers put behind their address for queries and for updates: Fuseki and Virtuoso, Oxigraph, RDF4J, others."""
NOTHING_ASKED, NOTHING_DONE = "ASK {}", "INSERT DATA {}"
ROWS = "application/sparql-results+json"


def find_endpoint(address: str, timeout_s: float = TIMEOUT_S) -> HttpEndpoint:
    """Return a server that answers queries and makes updates; StoreError when there is none at the address."""
    name = Address.parse(address)
    refusals: list[StoreError] = []
    for query, update in FORMS:
        endpoint = HttpEndpoint(address, query, update, timeout_s)
        try:
            endpoint.query(NOTHING_ASKED, ROWS)
            endpoint.update(NOTHING_DONE)
        except (RequestRefused, InvalidAnswer) as error:
            refusals.append(error)
        else:
            return endpoint
        endpoint.close()
    raise StoreError(f"no SPARQL 1.1 server takes queries and updates at {name}: {refusals[-1]}")
