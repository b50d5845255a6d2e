"""Sessions of browsers: how one begins, with a one-time code or a token, and ends."""

from __future__ import annotations

from http import HTTPStatus

from starlette.responses import Response

from skillc.contract.access import LoginCode, SessionInfo
from skillc.server.http.api_call import ApiCall


async def make_login_code(call: ApiCall) -> LoginCode:
    return LoginCode(call.server.codes.make(call.client.token))


async def show_session(call: ApiCall) -> SessionInfo:
    return SessionInfo(call.client.name, call.client.role)


async def log_in(call: ApiCall) -> Response:
    response = Response(status_code=HTTPStatus.NO_CONTENT)
    call.cookie.set(response, call.server.state.sessions.begin(call.client.token))
    call.server.run_readers.warm()  # a page asks for a tree next
    return response


async def log_out(call: ApiCall) -> Response:
    if call.session is not None:
        call.server.state.sessions.end(call.session)
    response = Response(status_code=HTTPStatus.NO_CONTENT)
    call.cookie.remove(response)
    return response
