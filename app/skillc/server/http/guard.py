"""Refuses requests that another page or another name of this machine sends, before anything reads them."""

from __future__ import annotations

from http import HTTPStatus
from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from skillc.server.problems import ApiRefusal, send_refusal


class Guard:
    """Lets requests pass whose `Host` is one of `hosts`, and whose `Origin`, if there is one, is a page of that host.

    So a page that a browser has from elsewhere can send nothing here, also not by a name that leads to this machine
    (DNS rebinding).
    """

    def __init__(self, app: ASGIApp, hosts: frozenset[str]) -> None:
        self._app, self._hosts = app, hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a request (ASGI)."""
        if scope["type"] == "lifespan" or (refused := self._find_refusal(Headers(scope=scope))) is None:
            await self._app(scope, receive, send)
        else:
            await send_refusal(refused, scope, receive, send)

    def _find_refusal(self, headers: Headers) -> ApiRefusal | None:
        hosts = headers.getlist("host")
        if len(hosts) != 1 or hosts[0].lower() not in self._hosts:
            return ApiRefusal(HTTPStatus.MISDIRECTED_REQUEST, "this server has another name; see --host")
        origin = headers.get("origin")
        if origin is not None and urlsplit(origin).netloc.lower() != hosts[0].lower():
            return ApiRefusal(HTTPStatus.FORBIDDEN, "requests of pages from elsewhere are refused")
        return None
