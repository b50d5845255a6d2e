"""The audit log, for administrators."""

from __future__ import annotations

from skillc.contract.audit import AuditEntry, AuditPage
from skillc.server.endpoint import ApiCall, ApiEndpoint


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
