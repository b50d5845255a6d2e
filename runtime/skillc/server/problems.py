"""Refusals of requests, as problem details (RFC 9457)."""

from __future__ import annotations

from http import HTTPStatus

import msgspec
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from skillc.server.api_types import ProblemDetails

MEDIA_TYPE = "application/problem+json"


class ApiRefusal(Exception):
    """A request is refused with a status."""

    def __init__(self, status: HTTPStatus, detail: str, allowed: tuple[str, ...] | None = None) -> None:
        super().__init__(detail)
        self.status = status
        self.problem = ProblemDetails(title=status.phrase, status=status.value, detail=detail, allowed=allowed)


async def send_refusal(refused: ApiRefusal, scope: Scope, receive: Receive, send: Send) -> None:
    """Refuse a request, or a WebSocket, before anything reads it (ASGI)."""
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008, "reason": refused.problem.title})
    else:
        content = msgspec.json.encode(refused.problem)
        await Response(content, refused.status, media_type=MEDIA_TYPE)(scope, receive, send)
