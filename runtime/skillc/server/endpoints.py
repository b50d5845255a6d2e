"""All endpoints below /api/v1."""

from __future__ import annotations

from skillc.server.endpoint import Endpoint
from skillc.server.routes import cells, operations, tokens

PREFIX = "/api/v1"
ENDPOINTS: tuple[Endpoint, ...] = (*cells.ENDPOINTS, *operations.ENDPOINTS, *tokens.ENDPOINTS)
