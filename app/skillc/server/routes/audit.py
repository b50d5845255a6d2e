"""The audit log, for administrators."""

from __future__ import annotations

from skillc.contract.audit import AuditEntry
from skillc.server.http.api_call import ApiCall


async def list_audit_entries(call: ApiCall) -> tuple[AuditEntry, ...]:
    return call.server.audit.entries(call.query.after, call.query.limit)
