"""Leases: who alone may command a cell for some time."""

from __future__ import annotations

from typing import Annotated

import msgspec


class Lease(msgspec.Struct, frozen=True):
    """The lease of a cell: who has it, and for how long yet, in s of wall time; nobody if `owner` is None."""

    cell: str
    owner: str | None
    remaining_s: float


MAX_LEASE_S = 3600.0


class LeaseRequest(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """For how long a client wants to command a cell alone, in s; `takeover` ends the lease of another client."""

    duration_s: Annotated[float, msgspec.Meta(gt=0.0, le=MAX_LEASE_S)] = 60.0
    takeover: bool = False
