"""Reads requests: their parameters and their bodies, within limits of size, depth and time."""

from __future__ import annotations

import asyncio
from http import HTTPStatus
from typing import Any

import msgspec
from starlette.requests import ClientDisconnect, Request

from skillc.contract.values import MAX_BODY_BYTES, CheckedBody
from skillc.server.problems import ApiRefusal

BODY_S = 10.0
"""How long a body may take to arrive, in s."""
MAX_KEY = 200
NO_JSON = "send application/json; nothing was done"
BAD_REQUEST, INVALID = HTTPStatus.BAD_REQUEST, HTTPStatus.UNPROCESSABLE_ENTITY


def read_query(request: Request, kind: type[msgspec.Struct]) -> msgspec.Struct:
    """Return the parameters of the query; ApiRefusal if they are not of this type."""
    names = [name for name, _ in request.query_params.multi_items()]
    if len(set(names)) < len(names):
        raise ApiRefusal(INVALID, "a parameter of the query is given twice")
    try:
        return msgspec.convert(dict(request.query_params), kind, strict=False)
    except msgspec.ValidationError as error:
        raise ApiRefusal(INVALID, f"query: {error}") from error


async def read_body(request: Request, needed: bool = True) -> bytes:
    """Return the body; ApiRefusal if it is not JSON by its type, too large, or does not arrive in time.

    One that is not `needed` may be empty, whatever its type.
    """
    is_json = request.headers.get("content-type", "").partition(";")[0].strip().lower() == "application/json"
    if needed and not is_json:
        raise ApiRefusal(HTTPStatus.UNSUPPORTED_MEDIA_TYPE, NO_JSON)
    content = await _receive_in_time(request)
    if content and not is_json:
        raise ApiRefusal(HTTPStatus.UNSUPPORTED_MEDIA_TYPE, NO_JSON)
    return content if content or needed else b"{}"


async def _receive_in_time(request: Request) -> bytes:
    try:
        return await asyncio.wait_for(_receive(request), BODY_S)
    except TimeoutError as error:
        raise ApiRefusal(HTTPStatus.REQUEST_TIMEOUT, f"the body did not arrive within {BODY_S:g} s") from error
    except ClientDisconnect as error:
        raise ApiRefusal(BAD_REQUEST, "the body is incomplete") from error


async def _receive(request: Request) -> bytes:
    parts, size = list[bytes](), 0
    async for part in request.stream():
        size += len(part)
        if size > MAX_BODY_BYTES:
            raise ApiRefusal(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, f"at most {MAX_BODY_BYTES} bytes are read")
        parts.append(part)
    return b"".join(parts)


def decode_body(content: bytes, kind: Any) -> Any:
    """Return the value of a body; ApiRefusal if it is no JSON, not of this type, or outside the limits of that."""
    try:
        value = msgspec.json.decode(content, type=kind)
    except msgspec.ValidationError as error:
        raise ApiRefusal(INVALID, str(error)) from error
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise ApiRefusal(BAD_REQUEST, f"the body is no JSON: {error}") from error
    if isinstance(value, CheckedBody):
        try:
            value.check()
        except ValueError as error:
            raise ApiRefusal(INVALID, str(error)) from error
    return value


def read_key(request: Request) -> str | None:
    """Return the Idempotency-Key; None without one. ApiRefusal if it is too long, or not printable ASCII."""
    key = request.headers.get("idempotency-key")
    if key is not None and not (0 < len(key) <= MAX_KEY and key.isascii() and key.isprintable()):
        raise ApiRefusal(BAD_REQUEST, f"an Idempotency-Key has 1 to {MAX_KEY} printable ASCII characters")
    return key


async def wait_until_gone(request: Request) -> None:
    """Return when the sender of a request, whose body was read, has closed the connection."""
    while (await request.receive())["type"] != "http.disconnect":
        pass
