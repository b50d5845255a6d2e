"""Requests to a server, and their answers as values."""

from __future__ import annotations

import ssl
from pathlib import Path
from typing import Literal, TypeVar
from urllib.parse import quote

import httpx
import msgspec

from skillc.client.address import ServerAddress
from skillc.client.errors import RefusedError, UnavailableError
from skillc.contract.problem import ProblemDetails
from skillc.errors import ServiceError
from skillc_dsl.rendering.json import from_data
from skillc_dsl.source import Source

TIMEOUT_S = 75.0
"""How long an answer may take, in s: a cell that plans or starts answers late."""
FIRST_SERVER_ERROR, UNAVAILABLE = 500, 503
UNAUTHORIZED = 401
Method = Literal["GET", "POST", "PUT", "DELETE"]
T = TypeVar("T")


class Connection:
    """A connection to a server. It belongs to one event loop."""

    def __init__(self, address: ServerAddress) -> None:
        self.address = address
        self.tls = ssl.create_default_context() if address.url.startswith("https:") else None
        self._client = httpx.AsyncClient(
            headers={"Authorization": f"Bearer {address.token}"},
            timeout=TIMEOUT_S,
            verify=self.tls or False,
            trust_env=not address.is_local,
        )

    async def close(self) -> None:
        """Close the connection; what goes on in the server goes on."""
        await self._client.aclose()

    async def get(self, path: str, kind: type[T], **query: object) -> T:
        """Read a resource; errors as of `send`."""
        return await self.send("GET", path, kind, query=query)

    async def send(
        self,
        method: Method,
        path: str,
        kind: type[T],
        body: object = None,
        query: dict[str, object] | None = None,
        key: str | None = None,
        repeatable: bool = False,
    ) -> T:
        """Make a request and return the answer. `key` makes the same request twice one.

        One that is `repeatable`, as those that read or have a key are, is made again if its connection is cut.

        RefusedError if the server refuses it, UnavailableError if it does not answer, or the cell is off.
        """
        headers = {} if body is None else {"Content-Type": "application/json"}
        if key is not None:
            headers["Idempotency-Key"] = key
        content = None if body is None else msgspec.json.encode(body)
        parameters = {name: str(value) for name, value in (query or {}).items() if value is not None}
        url = self.address.url + path
        try:
            request = self._client.build_request(method, url, content=content, params=parameters, headers=headers)
            answer = await self._send(request, repeatable or method == "GET" or key is not None)
        except (httpx.HTTPError, httpx.InvalidURL) as error:
            raise UnavailableError(describe_loss(self.address, error)) from error
        if not answer.is_success:
            raise _find_error(answer, self.address)
        return decode(answer.content or b"null", kind)

    async def _send(self, request: httpx.Request, repeatable: bool) -> httpx.Response:
        try:
            return await self._client.send(request)
        except (httpx.NetworkError, httpx.RemoteProtocolError):
            if not repeatable:
                raise
        return await self._client.send(request)

    async def download(self, path: str, file: Path) -> None:
        """Write a resource to a file, completely or not at all; errors as of `send`, ServiceError if not possible."""
        half = file.with_name(f"{file.name}.half")
        try:
            with half.open("wb") as target:
                async with self._client.stream("GET", self.address.url + path) as answer:
                    if not answer.is_success:
                        await answer.aread()
                        raise _find_error(answer, self.address)
                    async for piece in answer.aiter_bytes():
                        target.write(piece)
            half.replace(file)
        except (httpx.HTTPError, httpx.InvalidURL) as error:
            raise UnavailableError(describe_loss(self.address, error)) from error
        except OSError as error:
            raise ServiceError(f"{file} cannot be written: {error.strerror or error}") from error
        finally:
            half.unlink(missing_ok=True)


def decode(content: bytes | str, kind: type[T]) -> T:
    """Return what a server has sent as JSON; ServiceError if it is of another type."""
    try:
        return msgspec.json.decode(content, type=kind)
    except msgspec.DecodeError as error:
        raise _describe_unknown(error) from error


def decode_binary(content: bytes, kind: type[T]) -> T:
    """Return what a server has sent as MessagePack; ServiceError if it is of another type."""
    try:
        return msgspec.msgpack.decode(content, type=kind)
    except msgspec.DecodeError as error:
        raise _describe_unknown(error) from error


def _describe_unknown(error: msgspec.DecodeError) -> ServiceError:
    return ServiceError(f"the server sends what this version of skillc does not know: {error}")


def describe_loss(address: ServerAddress, error: Exception) -> str:
    """Return why a server cannot be reached, and what to do."""
    server = address.url.rpartition("/api")[0]
    if isinstance(error, httpx.TimeoutException | TimeoutError):
        return f"the server at {server} does not answer in time"
    reason = f" ({error})" if "certificate" in str(error).lower() else ""
    return f"no server answers at {server}{reason}; start one with `skillc serve`, or give the address of one"


def join(*parts: str) -> str:
    """Return a path of parts, each of which may be any text."""
    return "".join(f"/{quote(part, safe='')}" for part in parts)


def _find_error(answer: httpx.Response, address: ServerAddress) -> ServiceError:
    try:
        problem = msgspec.json.decode(answer.content, type=ProblemDetails)
    except msgspec.DecodeError:
        detail = f"{address.url} answers with {answer.status_code}: it is no server of skillc"
        problem = ProblemDetails(title="", status=answer.status_code, detail=detail)
    if answer.status_code >= FIRST_SERVER_ERROR:
        return UnavailableError(problem.detail)
    if answer.status_code == UNAUTHORIZED:
        unknown = f"the server at {address.url.rpartition('/api')[0]} does not know this token"
        return RefusedError(unknown, answer.status_code)
    return RefusedError(
        problem.detail,
        answer.status_code,
        problem.allowed or (),
        problem.type,
        tuple(map(from_data, problem.diagnostics or ())),
        {path: Source(path, text) for path, text in (problem.texts or {}).items()},
    )
