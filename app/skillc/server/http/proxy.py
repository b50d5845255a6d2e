"""Takes requests from a proxy only, and learns from it who made them."""

from __future__ import annotations

from http import HTTPStatus

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from skillc.server.problems import ApiRefusal, send_refusal


class ProxiedRequests:
    """Passes the requests that a proxy sends on, as from the client that the proxy names last in `X-Forwarded-For`."""

    def __init__(self, app: ASGIApp, proxy: str) -> None:
        self._app, self._proxy = app, proxy

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a request (ASGI)."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
        elif (scope.get("client") or ("", 0))[0] != self._proxy:
            refused = ApiRefusal(HTTPStatus.FORBIDDEN, "this server takes requests from its proxy only")
            await send_refusal(refused, scope, receive, send)
        else:
            forwarded = ",".join(Headers(scope=scope).getlist("x-forwarded-for")).rpartition(",")[2].strip()
            encrypted = {"http": "https", "websocket": "wss"}[scope["type"]]  # the proxy does that
            await self._app({**scope, "client": (forwarded or self._proxy, 0), "scheme": encrypted}, receive, send)
