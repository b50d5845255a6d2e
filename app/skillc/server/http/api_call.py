"""A request whose sender may make it, as handlers of endpoints get it."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from skillc.server.access.tokens import Client

if TYPE_CHECKING:
    from skillc.server.context import ServerContext
    from skillc.server.http.authentication import SessionCookie


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


Handler: TypeAlias = Callable[[ApiCall], Awaitable[object]]
"""Returns a value of the type that its endpoint answers, or raises ApiRefusal with one of its refusals.

With other media types than JSON it returns the Response itself.
"""
