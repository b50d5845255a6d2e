"""All endpoints below /api/v1."""

from __future__ import annotations

from skillc.server.endpoint import ApiEndpoint
from skillc.server.routes import cells, operations, tokens

PREFIX = "/api/v1"
ENDPOINTS: tuple[ApiEndpoint, ...] = (*cells.ENDPOINTS, *operations.ENDPOINTS, *tokens.ENDPOINTS)
