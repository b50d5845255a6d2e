"""Requests to a server, and their answers as values."""

from __future__ import annotations

import ssl
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeVar
from urllib.parse import quote

import httpx
import msgspec

from skillc.client.address import ServerAddress
from skillc.client.errors import RefusedError, UnavailableError
from skillc.contract.api.endpoint import Endpoint
from skillc.contract.api.problem import ProblemDetails
from skillc.errors import ServiceError
from skillc.values.arguments import require_text
from skillc_dsl.rendering.json import from_data
from skillc_dsl.source import Source

TIMEOUT_S = 75.0
"""How long an answer may take, in s: a cell that plans or starts answers late."""
UNAUTHORIZED, FIRST_SERVER_ERROR = 401, 500
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

    async def call(
        self,
        endpoint: Endpoint[T],
        *path: str,
        body: object = None,
        query: msgspec.Struct | None = None,
        key: str | None = None,
    ) -> T:
        """Make the request of an endpoint, with the parts of its path, and return the answer.

        `key` makes the same request twice one. One that reads, stops or has a key is made again if its connection is
        cut.

        RefusedError if the server refuses it, UnavailableError if it does not answer, or the cell is off.
        """
        headers = {} if body is None else {"Content-Type": "application/json"}
        if key is not None:
            headers["Idempotency-Key"] = key
        content = None if body is None else msgspec.json.encode(body)
        url = self.address.url + make_path(endpoint, path)
        try:
            request = self._client.build_request(
                endpoint.method, url, content=content, params=_list_parameters(query), headers=headers
            )
            answer = await self._send(request, endpoint.is_repeatable or key is not None)
        except (httpx.HTTPError, httpx.InvalidURL) as error:
            raise UnavailableError(describe_loss(self.address, error)) from error
        if not answer.is_success:
            raise _find_error(answer, self.address)
        return decode(answer.content or b"null", endpoint.answer)

    async def _send(self, request: httpx.Request, repeatable: bool) -> httpx.Response:
        try:
            return await self._client.send(request)
        except (httpx.NetworkError, httpx.RemoteProtocolError):
            if not repeatable:
                raise
        return await self._client.send(request)

    async def download(self, endpoint: Endpoint[None], *path: str, file: Path) -> None:
        """Write what an endpoint sends to a file, completely or not at all; errors as of `call`.

        ServiceError if the file cannot be written.
        """
        half = file.with_name(f"{file.name}.half")
        try:
            with half.open("wb") as target:
                async with self._client.stream(endpoint.method, self.address.url + make_path(endpoint, path)) as answer:
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


def make_path(endpoint: Endpoint[Any], parts: Sequence[str]) -> str:
    """Return the path of an endpoint with parts, each of which may be any text; RequestError for anything else."""
    quoted = {
        name: quote(require_text(part, f"the {name}"), safe="")
        for name, part in zip(endpoint.path_parameters, parts, strict=True)
    }
    return endpoint.path.format_map(quoted)


def _list_parameters(query: msgspec.Struct | None) -> dict[str, str]:
    """Return the parameters of a query; one that is None is not given."""
    given = {} if query is None else msgspec.structs.asdict(query)
    return {
        name: str(value).lower() if isinstance(value, bool) else str(value)
        for name, value in given.items()
        if value is not None
    }


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
    return describe_problem(problem)


def describe_problem(problem: ProblemDetails) -> RefusedError:
    """Return what a server says of what it has not done as an error."""
    return RefusedError(
        problem.detail,
        problem.status,
        problem.allowed or (),
        problem.type,
        tuple(map(from_data, problem.diagnostics or ())),
        {path: Source(path, text) for path, text in (problem.texts or {}).items()},
    )
