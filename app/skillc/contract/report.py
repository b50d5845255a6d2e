"""Reports of operations that have ended."""

from __future__ import annotations

import msgspec


class ReportRequest(
    msgspec.Struct, frozen=True, kw_only=True, tag_field="kind", tag="report", forbid_unknown_fields=True
):
    """An operation that has ended, to make a report of: without a `film` it takes a fraction of the time."""

    operation: str
    film: bool = True
