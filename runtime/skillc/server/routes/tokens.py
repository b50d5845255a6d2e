"""Tokens: adding, listing and revoking them."""

from __future__ import annotations

from http import HTTPStatus

import msgspec

from skillc.server.access.roles import Role
from skillc.server.access.tokens import TokenExists, TokenInfo
from skillc.server.endpoint import ApiCall, ApiEndpoint
from skillc.server.problems import ApiRefusal
from skillc.server.values import Name


class NewToken(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A token to be made."""

    name: Name
    role: Role


class MadeToken(msgspec.Struct, frozen=True):
    """A token that was made; `token` is shown this once."""

    name: str
    role: Role
    token: str


async def list_tokens(call: ApiCall) -> tuple[TokenInfo, ...]:
    return call.server.state.tokens.list()


async def add_token(call: ApiCall) -> MadeToken:
    try:
        token = call.server.state.tokens.add(call.body.name, call.body.role)
    except TokenExists as error:
        raise ApiRefusal(HTTPStatus.CONFLICT, str(error)) from error
    return MadeToken(call.body.name, call.body.role, token)


async def revoke_token(call: ApiCall) -> None:
    if call.path["name"] == call.client.name:
        raise ApiRefusal(HTTPStatus.CONFLICT, "a token cannot revoke itself; use another one")
    if not call.server.state.tokens.revoke(call.path["name"]):
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no token `{call.path['name']}`")


ENDPOINTS = (
    ApiEndpoint("GET", "/tokens", "admin", "List the tokens", list_tokens, tuple[TokenInfo, ...]),
    ApiEndpoint(
        "POST",
        "/tokens",
        "admin",
        "Make a token",
        add_token,
        MadeToken,
        body=NewToken,
        status=HTTPStatus.CREATED,
        refusals=(HTTPStatus.CONFLICT,),
    ),
    ApiEndpoint(
        "DELETE",
        "/tokens/{name}",
        "admin",
        "Revoke a token",
        revoke_token,
        status=HTTPStatus.NO_CONTENT,
        refusals=(HTTPStatus.NOT_FOUND, HTTPStatus.CONFLICT),
    ),
)
