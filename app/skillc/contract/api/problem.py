"""Why a request is refused, as problem details (RFC 9457)."""

from __future__ import annotations

import msgspec

from skillc_dsl.rendering.json import DiagnosticData


class ProblemDetails(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Why a request was refused; nothing has changed. `detail` says what to do.

    `type` is `about:blank`, and `title` the phrase of the status, unless there is more to know than the status.
    `allowed` are the commands that the state of an operation allows. `diagnostics` are the errors of a goal, a call or
    an argument, as of `skillc check --json`, and `texts` what they point into, by path; long texts are left out.
    """

    type: str = "about:blank"
    title: str
    status: int
    detail: str
    allowed: tuple[str, ...] | None = None
    diagnostics: tuple[DiagnosticData, ...] | None = None
    texts: dict[str, str] | None = None
