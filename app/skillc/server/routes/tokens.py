"""Tokens: adding, listing and revoking them."""

from __future__ import annotations

from http import HTTPStatus

from skillc.contract.access import MadeToken, TokenInfo
from skillc.server.access.tokens import TokenExists
from skillc.server.http.api_call import ApiCall
from skillc.server.problems import ApiRefusal


async def list_tokens(call: ApiCall) -> tuple[TokenInfo, ...]:
    return call.server.state.tokens.list()


async def add_token(call: ApiCall) -> MadeToken:
    if call.body.agent and call.body.role == "admin":
        raise ApiRefusal(
            HTTPStatus.CONFLICT, "an agent cannot have the role `admin`, with which it could make other tokens"
        )
    try:
        token = call.server.state.tokens.add(call.body.name, call.body.role, call.body.agent)
    except TokenExists as error:
        raise ApiRefusal(HTTPStatus.CONFLICT, str(error)) from error
    return MadeToken(call.body.name, call.body.role, token)


async def revoke_token(call: ApiCall) -> None:
    if call.path["name"] == call.client.name:
        raise ApiRefusal(HTTPStatus.CONFLICT, "a token cannot revoke itself; use another one")
    if not call.server.state.tokens.revoke(call.path["name"]):
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no token `{call.path['name']}`")
