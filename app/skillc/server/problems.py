"""Refusals of requests, as problem details (RFC 9457)."""

from __future__ import annotations

from dataclasses import dataclass
from http import HTTPStatus

import msgspec
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from skillc.contract.api.problem import ProblemDetails
from skillc.contract.diagnosis import NO_DIAGNOSIS, Diagnosis
from skillc_dsl.rendering.json import to_data

MEDIA_TYPE = "application/problem+json"
TYPES = "https://w3id.org/skillc/problems/"


@dataclass(frozen=True, slots=True)
class ProblemKind:
    """What makes a problem one that a client treats in a way of its own, with the IRI that identifies it."""

    type: str
    title: str


DIAGNOSTICS = ProblemKind(f"{TYPES}diagnostics", "The request has errors")
NOT_ALLOWED = ProblemKind(f"{TYPES}not-allowed", "The state does not allow the command")
LEASE_HELD = ProblemKind(f"{TYPES}lease-held", "Another client commands the cell")
KEY_REUSED = ProblemKind(f"{TYPES}key-reused", "The key belongs to another request")


class ApiRefusal(Exception):
    """A request is refused with a status; its `kind` is known by what comes with it, or nothing but the status."""

    def __init__(
        self,
        status: HTTPStatus,
        detail: str,
        allowed: tuple[str, ...] | None = None,
        diagnosis: Diagnosis = NO_DIAGNOSIS,
        kind: ProblemKind | None = None,
    ) -> None:
        super().__init__(detail)
        self.status = status
        if diagnosis.diagnostics:
            kind = DIAGNOSTICS
        elif allowed is not None:
            kind = NOT_ALLOWED
        self.problem = ProblemDetails(
            type=kind.type if kind else "about:blank",
            title=kind.title if kind else status.phrase,
            status=status.value,
            detail=detail,
            allowed=allowed,
            diagnostics=tuple(map(to_data, diagnosis.diagnostics)) or None,
            texts=diagnosis.texts or None,
        )


async def send_refusal(refused: ApiRefusal, scope: Scope, receive: Receive, send: Send) -> None:
    """Refuse a request, or a WebSocket, before anything reads it (ASGI)."""
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008, "reason": refused.problem.title})
    else:
        content = msgspec.json.encode(refused.problem)
        await Response(content, refused.status, media_type=MEDIA_TYPE)(scope, receive, send)
