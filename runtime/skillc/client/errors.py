"""What goes wrong between a client and a server."""

from __future__ import annotations

from skillc.services.errors import RequestError, ServiceError


class RefusedError(RequestError):
    """The server refuses a request, and nothing has changed; the message says why.

    `status` is that of the answer (HTTP), `allowed` are the commands that the state of an operation allows.
    """

    exit_code = 1

    def __init__(self, message: str, status: int, allowed: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.status, self.allowed = status, allowed


class UnavailableError(ServiceError):
    """The server, or what is needed of it, does not answer now; the same may be possible later."""
