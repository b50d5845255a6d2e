"""The metrics of the server, for Prometheus."""

from __future__ import annotations

from starlette.responses import Response

from skillc.server.endpoint import ApiCall, ApiEndpoint
from skillc.server.metrics import CONTENT_TYPE, MEDIA_TYPE


async def show_metrics(call: ApiCall) -> Response:
    return Response(call.server.metrics.format(), headers={"Cache-Control": "no-store"}, media_type=CONTENT_TYPE)


ENDPOINTS = (
    ApiEndpoint(
        "GET",
        "/metrics",
        "view",
        "Read the metrics of the server for Prometheus",
        show_metrics,
        media_types=(MEDIA_TYPE,),
    ),
)
