"""Who may do what: roles, tokens, and sessions of browsers."""

from __future__ import annotations

from typing import Literal, TypeAlias, get_args

import msgspec

from skillc.contract.values import CheckedBody, Name, check_name

Role: TypeAlias = Literal["view", "operate", "edit", "admin"]
"""`view`: see everything, and stop. `operate`: start operations and give commands. `edit`: change the world, libraries
and scenes. `admin`: tokens, backups, cells."""
ROLES: tuple[Role, ...] = get_args(Role)


class TokenInfo(msgspec.Struct, frozen=True):
    """A token as it is listed, without its secret; `created_ns` is in ns since 1970-01-01 UTC."""

    name: str
    role: Role
    created_ns: int
    agent: bool = False


class LoginCode(msgspec.Struct, frozen=True):
    """A code that a request may have in the place of a token, once, within 60 s."""

    code: str


class SessionInfo(msgspec.Struct, frozen=True):
    """Who makes a request: the name of its token, and what it may do."""

    name: str
    role: Role


class NewToken(CheckedBody, frozen=True, forbid_unknown_fields=True):
    """A token to be made. What an `agent` asks for waits for the approval of somebody else."""

    name: Name
    role: Role
    agent: bool = False

    def check(self) -> None:
        """Raise ValueError for a name with other characters."""
        check_name(self.name)


class MadeToken(msgspec.Struct, frozen=True):
    """A token that was made; `token` is shown this once."""

    name: str
    role: Role
    token: str
