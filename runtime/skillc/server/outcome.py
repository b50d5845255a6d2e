"""Turns what a cell answers into what the API answers.

A body that does not fit its type is 422. What fits, but cannot be done with the library and the world that the cell has
now, such as a task that it does not have, is 409.
"""

from __future__ import annotations

from http import HTTPStatus
from typing import assert_never

from skillc.cells.messages import Refused
from skillc.server.problems import ApiRefusal

UNAVAILABLE = (HTTPStatus.TOO_MANY_REQUESTS, HTTPStatus.SERVICE_UNAVAILABLE)
"""The statuses with which a cell that is busy or off refuses everything."""


def raise_refused(refused: Refused | None) -> None:
    """Raise ApiRefusal if a cell has refused a request."""
    if refused is not None:
        raise ApiRefusal(_find_status(refused), refused.reason, refused.allowed or None)


def _find_status(refused: Refused) -> HTTPStatus:
    match refused.kind:
        case "invalid" | "state":
            return HTTPStatus.CONFLICT
        case "busy":
            return HTTPStatus.TOO_MANY_REQUESTS
        case "off":
            return HTTPStatus.SERVICE_UNAVAILABLE
        case _:
            assert_never(refused.kind)
