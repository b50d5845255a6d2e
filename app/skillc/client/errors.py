"""What goes wrong between a client and a server."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from skillc.errors import RequestError, ServiceError
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source

NO_TEXTS: Mapping[str, Source] = MappingProxyType({})


class RefusedError(RequestError):
    """The server refuses a request, and nothing has changed; the message says why.

    `status` is that of the answer (HTTP), `type` identifies the kind of problem if there is more to know (RFC 9457).
    `allowed` are the commands that the state of an operation allows, `diagnostics` the errors of a goal, a call or an
    argument, which point into `texts`.
    """

    exit_code = 1

    def __init__(
        self,
        message: str,
        status: int,
        allowed: Sequence[str] = (),
        type: str = "about:blank",
        diagnostics: Sequence[Diagnostic] = (),
        texts: Mapping[str, Source] = NO_TEXTS,
    ) -> None:
        super().__init__(message)
        self.status, self.allowed, self.type = status, tuple(allowed), type
        self.diagnostics, self.texts = tuple(diagnostics), texts


class UnavailableError(ServiceError):
    """The server, or what is needed of it, does not answer now; the same may be possible later."""
