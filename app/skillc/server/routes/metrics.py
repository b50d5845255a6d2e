"""The metrics of the server, for Prometheus."""

from __future__ import annotations

from starlette.responses import Response

from skillc.server.http.api_call import ApiCall
from skillc.server.metrics import CONTENT_TYPE


async def show_metrics(call: ApiCall) -> Response:
    return Response(call.server.metrics.format(), headers={"Cache-Control": "no-store"}, media_type=CONTENT_TYPE)
