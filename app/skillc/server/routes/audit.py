"""The audit log, for administrators."""

from __future__ import annotations

from typing import Annotated

import msgspec

from skillc.server.audit import AuditEntry
from skillc.server.endpoint import ApiCall, ApiEndpoint


class AuditPage(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Which entries: those after a number, and how many at most."""

    after: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] = 0
    limit: Annotated[int, msgspec.Meta(ge=1, le=10_000)] = 1000


async def list_audit_entries(call: ApiCall) -> tuple[AuditEntry, ...]:
    return call.server.audit.entries(call.query.after, call.query.limit)


ENDPOINTS = (
    ApiEndpoint(
        "GET",
        "/audit",
        "admin",
        "Read the audit log: what was changed, by whom, and what was refused",
        list_audit_entries,
        tuple[AuditEntry, ...],
        query=AuditPage,
    ),
)
