"""The application: each endpoint behind the checks of who may use it, how often, and with what."""

from __future__ import annotations

import sqlite3
import time
from collections import Counter
from collections.abc import Awaitable, Callable, Iterable, Mapping
from functools import partial
from http import HTTPStatus
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType, NoneType
from typing import Any
from urllib.parse import urlsplit

import msgspec
from starlette.applications import Starlette
from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import BaseRoute, Route, WebSocketRoute
from starlette.types import ASGIApp, Receive, Scope, Send

from skillc.cells.database import DatabaseError
from skillc.contract.api.endpoint import PREFIX, Endpoint
from skillc.contract.api.endpoints import ENDPOINTS, STREAMS, UNAVAILABLE
from skillc.server import routes
from skillc.server.access.rates import TokenBuckets
from skillc.server.access.roles import includes
from skillc.server.access.tokens import Client
from skillc.server.context import ServerContext
from skillc.server.http.api_call import ApiCall, Handler
from skillc.server.http.audited_request import AuditedRequest
from skillc.server.http.authentication import find_cookie, find_known_client, read_session
from skillc.server.http.event_stream import stream_events
from skillc.server.http.openapi import make_openapi
from skillc.server.http.requests import decode_body, read_body, read_key, read_query, wait_until_gone
from skillc.server.http.sample_stream import stream_samples
from skillc.server.language.stream import stream_language
from skillc.server.log import log
from skillc.server.problems import MEDIA_TYPE, ApiRefusal, send_refusal
from skillc.server.studio_page import STUDIO_FILES, StudioPage


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


def find_handlers(endpoints: Iterable[Endpoint[Any]]) -> Mapping[str, Handler]:
    """Return the handlers of endpoints by name; KeyError if one has none."""
    known = {name: each for module in list_modules() for name, each in vars(module).items()}
    return {each.name: known[each.name] for each in endpoints}


def list_modules() -> list[ModuleType]:
    """Return the modules with handlers."""
    return [import_module(f"{routes.__name__}.{each.name}") for each in iter_modules(routes.__path__)]


REQUESTS_PER_S, BURST = 200.0, 400.0
"""How many requests a client may make; stops are not counted."""
MAX_ONGOING = 100
"""How many requests of a client may be answered at the same time; stops are not counted."""

AUDITED_REFUSALS = (HTTPStatus.UNAUTHORIZED, HTTPStatus.FORBIDDEN, HTTPStatus.TOO_MANY_REQUESTS)
DETAILS = {404: "there is no such path", 405: "this path does not have this method"}


class Application:
    """Serves the endpoints of a server."""

    def __init__(self, server: ServerContext, hosts: frozenset[str], proxy: str | None = None) -> None:
        """Serve requests that name one of `hosts`, with port if it is not the default one; only those of a proxy."""
        self._server = server
        self._requests = TokenBuckets(REQUESTS_PER_S, BURST)
        self._ongoing = Counter[str]()
        document = msgspec.json.encode(make_openapi(ENDPOINTS, PREFIX))
        self._handlers = find_handlers(ENDPOINTS)
        by_path: dict[str, dict[str, Endpoint[Any]]] = {}
        for each in ENDPOINTS:
            by_path.setdefault(each.path, {})[each.method] = each
        studio = StudioPage(STUDIO_FILES)
        streams = {
            "stream_events": partial(stream_events, server),
            "stream_samples": partial(stream_samples, server, {}),
            "stream_language": partial(stream_language, server),
        }
        routes = [
            Route(PREFIX + path, partial(self._answer, methods), methods=list(methods))
            for path, methods in by_path.items()
        ]
        self.routes: tuple[BaseRoute, ...] = (
            *routes,
            Route("/metrics", partial(self._answer, by_path["/metrics"])),
            Route(f"{PREFIX}/health", _constant(b'{"status":"ok"}')),
            Route(f"{PREFIX}/openapi.json", _constant(document)),
            Route("/", studio.show_page),
            Route("/assets/{path:path}", studio.show_asset),
            *(WebSocketRoute(PREFIX + each.path, streams[each.name]) for each in STREAMS),
        )
        app = Starlette(routes=self.routes, exception_handlers={HTTPException: _refuse_unknown})
        guarded = Guard(app, hosts)
        self.asgi: ASGIApp = guarded if proxy is None else ProxiedRequests(guarded, proxy)

    async def _answer(self, methods: dict[str, Endpoint[Any]], request: Request) -> Response:
        """Answer a request; what changes something, or is refused for who made it, is written to the audit log."""
        endpoint = methods["GET" if request.method == "HEAD" else request.method]
        began, noted = time.monotonic(), AuditedRequest(self._server, request)
        try:
            noted.client = find_known_client(self._server, request)
            self._check_allowed(endpoint, noted.client)
            response = await self._carry_out(endpoint, noted.client, noted, request)
        except ApiRefusal as refused:
            response, noted.detail = refuse(refused), refused.problem.detail
        except (DatabaseError, sqlite3.Error) as error:
            noted.detail = self._server.state.describe(error)
            response = refuse(ApiRefusal(HTTPStatus.SERVICE_UNAVAILABLE, noted.detail))
        if endpoint.method != "GET" or response.status_code in AUDITED_REFUSALS:
            noted.end(response.status_code)
        self._report(endpoint, noted.client, request, response.status_code, time.monotonic() - began)
        return response

    def _report(
        self, endpoint: Endpoint[Any], client: Client | None, request: Request, status: int, seconds: float
    ) -> None:
        self._server.metrics.observe(endpoint.method, endpoint.path, status, seconds)
        who = client.name if client else ""
        log("request", method=request.method, path=request.url.path, status=status, who=who, ms=round(seconds * 1e3, 2))

    def _check_allowed(self, endpoint: Endpoint[Any], client: Client) -> None:
        """Raise ApiRefusal (403, 429) if a client may not make a request, or not so many."""
        if not includes(client.role, endpoint.role):
            needed = f"this needs the role `{endpoint.role}`, and `{client.name}` has `{client.role}`"
            raise ApiRefusal(HTTPStatus.FORBIDDEN, needed)
        if endpoint.unlimited:
            return
        if not self._requests.take(client.name):
            raise ApiRefusal(HTTPStatus.TOO_MANY_REQUESTS, f"at most {REQUESTS_PER_S:g} requests a second")
        if self._ongoing[client.name] >= MAX_ONGOING:
            raise ApiRefusal(HTTPStatus.TOO_MANY_REQUESTS, f"at most {MAX_ONGOING} requests at the same time")

    async def _carry_out(
        self, endpoint: Endpoint[Any], client: Client, noted: AuditedRequest, request: Request
    ) -> Response:
        self._ongoing[client.name] += not endpoint.unlimited
        try:
            return await self._call(endpoint, client, noted, request)
        finally:
            self._ongoing[client.name] -= not endpoint.unlimited

    async def _call(self, endpoint: Endpoint[Any], client: Client, noted: AuditedRequest, request: Request) -> Response:
        query = read_query(request, endpoint.query)
        content = b"" if endpoint.body is None else await read_body(request, endpoint.needs_body)
        body = None if endpoint.body is None else decode_body(content, endpoint.body)
        key = read_key(request) if endpoint.takes_key else None
        noted.content = content
        if endpoint.method != "GET" and not endpoint.unlimited:
            noted.begin()
        leave = partial(wait_until_gone, request)
        session = find_cookie(request), read_session(request)
        call = ApiCall(self._server, client, request.path_params, query, body, content, key, leave, *session)
        answer = await self._handlers[endpoint.name](call)
        if isinstance(answer, Response):
            return answer
        if endpoint.answer is NoneType:
            return Response(status_code=endpoint.status)
        return make_response(endpoint.status, answer, endpoint.media_types[0])


def make_response(status: HTTPStatus, value: object, media_type: str) -> Response:
    """Return an answer with a value as JSON, which nobody caches."""
    headers = {"Cache-Control": "no-store", "X-Content-Type-Options": "nosniff"}
    return Response(msgspec.json.encode(value), status, headers, media_type)


def refuse(refused: ApiRefusal) -> Response:
    """Return the answer of a refusal."""
    response = make_response(refused.status, refused.problem, MEDIA_TYPE)
    if refused.status is HTTPStatus.UNAUTHORIZED:
        response.headers["WWW-Authenticate"] = "Bearer"
    if refused.status in UNAVAILABLE:
        response.headers["Retry-After"] = "1"
    return response


async def _refuse_unknown(_: Request, error: Exception) -> Response:
    """Return the answer for a path or a method that does not exist."""
    assert isinstance(error, HTTPException)
    response = refuse(ApiRefusal(HTTPStatus(error.status_code), DETAILS.get(error.status_code, error.detail)))
    response.headers.update(error.headers or {})
    return response


def _constant(content: bytes) -> Callable[[Request], Awaitable[Response]]:
    async def answer(_: Request) -> Response:
        return Response(content, media_type="application/json")

    return answer


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
