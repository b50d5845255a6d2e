"""The roles of clients: each may do what the roles before it may."""

from __future__ import annotations

from typing import Literal, TypeAlias, get_args

Role: TypeAlias = Literal["view", "operate", "edit", "admin"]
"""`view`: see everything, and stop. `operate`: start operations and give commands. `edit`: change the world, libraries
and scenes. `admin`: tokens, backups, cells."""

ROLES: tuple[Role, ...] = get_args(Role)


def includes(role: Role, needed: Role) -> bool:
    """Whether a client with `role` may do what needs the role `needed`."""
    return ROLES.index(role) >= ROLES.index(needed)
