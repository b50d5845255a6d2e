"""A request to a server as its audit log has it."""

from __future__ import annotations

import sqlite3
from dataclasses import dataclass
from http import HTTPStatus

from starlette.requests import HTTPConnection

from skillc.server.access.audit import MAX_TEXT
from skillc.server.access.tokens import Client
from skillc.server.context import ServerContext
from skillc.server.log import log


@dataclass(slots=True)
class AuditedRequest:
    """A request, or a WebSocket, as the audit log has it: `client` made it, `detail` is why it is refused.

    `content` is its body once that is known to be one of its endpoint; bodies have no secrets.
    """

    server: ServerContext
    connection: HTTPConnection
    client: Client | None = None
    detail: str = ""
    content: bytes = b""
    _number: int | None = None

    def begin(self) -> None:
        """Note the request before anything is changed; an error of the database keeps it from being carried out."""
        self._number = self._add(0)

    def end(self, status: int) -> None:
        """Note how it was answered. If that cannot be written, the log of the server has it: the answer stays."""
        if self.client is None and status == HTTPStatus.TOO_MANY_REQUESTS:
            return  # so that nobody without a token fills the disk
        try:
            if self._number is None:
                self._add(status)
            else:
                self.server.audit.complete(self._number, status, self.detail)
        except sqlite3.Error as error:
            log("audit", problem=self.server.state.describe(error))

    def _add(self, status: int) -> int:
        connection, who = self.connection, self.client.name if self.client is not None else ""
        method = connection.scope.get("method", "WebSocket")
        origin = connection.client.host if connection.client else ""
        body = " ".join(self.content[:MAX_TEXT].decode("utf-8", "replace").split())
        return self.server.audit.add(
            who, origin, f"{method} {connection.url.path} {body}".rstrip(), status, self.detail
        )
