"""The roles of clients: each may do what the roles before it may."""

from __future__ import annotations

from skillc.contract.access import ROLES, Role


def includes(role: Role, needed: Role) -> bool:
    """Whether a client with `role` may do what needs the role `needed`."""
    return ROLES.index(role) >= ROLES.index(needed)
