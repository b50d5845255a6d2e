"""All endpoints below /api/v1."""

from __future__ import annotations

from skillc.server.endpoint import ApiEndpoint
from skillc.server.routes import (
    audit,
    cells,
    disturbances,
    geometry,
    leases,
    libraries,
    metrics,
    operations,
    orders,
    plans,
    recordings,
    rehearsals,
    reports,
    runs,
    sessions,
    sources,
    tokens,
    trials,
    world,
)

PREFIX = "/api/v1"
ENDPOINTS: tuple[ApiEndpoint, ...] = (
    *cells.ENDPOINTS,
    *disturbances.ENDPOINTS,
    *geometry.ENDPOINTS,
    *leases.ENDPOINTS,
    *operations.ENDPOINTS,
    *orders.ENDPOINTS,
    *recordings.ENDPOINTS,
    *runs.ENDPOINTS,
    *world.ENDPOINTS,
    *libraries.ENDPOINTS,
    *plans.ENDPOINTS,
    *rehearsals.ENDPOINTS,
    *reports.ENDPOINTS,
    *sessions.ENDPOINTS,
    *sources.ENDPOINTS,
    *tokens.ENDPOINTS,
    *trials.ENDPOINTS,
    *audit.ENDPOINTS,
    *metrics.ENDPOINTS,
)
