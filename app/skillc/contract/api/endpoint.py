"""Endpoints as data: the routes of the server, the OpenAPI document, the clients and the tests are made of them."""

from __future__ import annotations

from dataclasses import dataclass
from http import HTTPStatus
from typing import Any, Generic, Literal, TypeAlias, TypeVar

import msgspec

from skillc.contract.access import Role

PREFIX = "/api/v1"
JSON = "application/json"
Method: TypeAlias = Literal["GET", "POST", "PUT", "DELETE"]
A = TypeVar("A")


class Empty(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """No parameters."""


@dataclass(frozen=True, slots=True)
class Endpoint(Generic[A]):
    """A method of a path below /api/v1, for clients with a role; `name` is that of its handler, and unique.

    `answer` is the type of what it answers, NoneType for nothing, and for files, which have other `media_types` than
    JSON. `refusals` are the statuses with which it may refuse a request, besides those that any has. An empty body
    counts as one without values unless it `needs_body`. Only those that are `unlimited` are answered whatever the rate
    of requests is: stops, which may be repeated.

    `call` is the method of clients that makes this request and does nothing else, by default `name`; None if what
    clients do is more than that, or nothing.
    """

    name: str
    method: Method
    path: str
    role: Role
    summary: str
    answer: type[A]
    body: Any = None
    needs_body: bool = True
    query: type[msgspec.Struct] = Empty
    status: HTTPStatus = HTTPStatus.OK
    refusals: tuple[HTTPStatus, ...] = ()
    takes_key: bool = False
    unlimited: bool = False
    media_types: tuple[str, ...] = (JSON,)
    call: str | None = ""

    @property
    def is_repeatable(self) -> bool:
        """Whether the same request twice is one: it reads, or stops."""
        return self.method == "GET" or self.unlimited

    @property
    def path_parameters(self) -> tuple[str, ...]:
        """The names of the parts of the path that a request gives."""
        return tuple(part[1:-1] for part in self.path.split("/") if part.startswith("{"))


@dataclass(frozen=True, slots=True)
class Stream:
    """A WebSocket below /api/v1; a client says `hello` first, in JSON, and then gets messages of a type.

    They are MessagePack if they are `binary`, else JSON.
    """

    name: str
    path: str
    role: Role
    summary: str
    hello: type[msgspec.Struct]
    message: Any
    binary: bool = False
