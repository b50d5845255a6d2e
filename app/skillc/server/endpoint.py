"""Endpoints as data: the routes of the server, the OpenAPI document and the tests are made of them."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from http import HTTPStatus
from typing import TYPE_CHECKING, Any, Literal

import msgspec

from skillc.contract.access import Role
from skillc.server.access.tokens import Client

if TYPE_CHECKING:
    from skillc.server.authentication import SessionCookie
    from skillc.server.context import ServerContext

JSON = "application/json"
Method = Literal["GET", "POST", "PUT", "DELETE"]


class Empty(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """No parameters."""


@dataclass(frozen=True, slots=True)
class ApiCall:
    """A request whose sender may make it; `body` and `query` are of the types of its endpoint.

    `key` is the Idempotency-Key, `content` the body as it was sent; `leave` returns when the sender has gone.
    `cookie` is that of sessions, `session` the secret that it holds.
    """

    server: ServerContext
    client: Client
    path: Mapping[str, str]
    query: Any
    body: Any
    content: bytes
    key: str | None
    leave: Callable[[], Awaitable[None]]
    cookie: SessionCookie
    session: str | None


@dataclass(frozen=True, slots=True)
class ApiEndpoint:
    """A method of a path below /api/v1, for clients with a role.

    `handle` returns a value of the type `answer`, or raises ApiRefusal with one of `refusals`. With other media types
    than JSON it returns the Response itself. An empty body counts as one without values unless the endpoint
    `needs_body`. Only endpoints that are `unlimited` are answered whatever the rate of requests is.
    """

    method: Method
    path: str
    role: Role
    summary: str
    handle: Callable[[ApiCall], Awaitable[object]]
    answer: Any = None
    body: Any = None
    needs_body: bool = True
    query: type[msgspec.Struct] = Empty
    status: HTTPStatus = HTTPStatus.OK
    refusals: tuple[HTTPStatus, ...] = ()
    takes_key: bool = False
    unlimited: bool = False
    media_types: tuple[str, ...] = (JSON,)
