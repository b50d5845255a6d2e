"""Reports of operations that have ended."""

from __future__ import annotations

from typing import Literal

import msgspec

from skillc_runtime.evaluation.report.result import TaskResult


class ReportRequest(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a report has: without a `film` it is made in a fraction of the time."""

    film: bool = True


REPORT_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".json": "application/json",
    ".mp4": "video/mp4",
    ".png": "image/png",
    ".svg": "image/svg+xml",
}
"""The media types of the files of a report."""


class OperationReport(msgspec.Struct, frozen=True, kw_only=True):
    """The report of an operation. `result` is null until it is made, and then if it cannot be: `reason` says why.

    `files` are the names of what can be read of it: the report, a film, figures and pictures.
    """

    operation: str
    state: Literal["going on", "ended"] = "going on"
    reason: str = ""
    result: TaskResult | None = None
    files: tuple[str, ...] = ()
