"""The audit log as it is read."""

from __future__ import annotations

from typing import Annotated

import msgspec


class AuditEntry(msgspec.Struct, frozen=True):
    """A request that changed something, or that was refused; `wall_ns` is in ns since 1970-01-01 UTC.

    `status` is that of the answer; 0 while it is carried out, and if it was when the server ended or its disk was full.
    """

    number: int
    wall_ns: int
    who: str
    origin: str
    action: str
    status: int
    detail: str


class AuditPage(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Which entries: those after a number, and how many at most."""

    after: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] = 0
    limit: Annotated[int, msgspec.Meta(ge=1, le=10_000)] = 1000
