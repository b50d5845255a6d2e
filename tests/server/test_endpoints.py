"""Endpoints of the contract: each has one handler, which returns what the contract says."""

from __future__ import annotations

import inspect
from types import NoneType
from typing import Any, get_type_hints

import pytest
from starlette.responses import Response

from skillc.contract.api.endpoint import JSON, Endpoint
from skillc.contract.api.endpoints import ENDPOINTS, STREAMS
from skillc.server.app import find_handlers, list_modules

HANDLERS = find_handlers(ENDPOINTS)


def test_names_and_requests_are_unique() -> None:
    assert len({each.name for each in (*ENDPOINTS, *STREAMS)}) == len(ENDPOINTS) + len(STREAMS)
    assert len({(each.method, each.path) for each in ENDPOINTS}) == len(ENDPOINTS)


@pytest.mark.parametrize("endpoint", ENDPOINTS, ids=lambda each: each.name)
def test_a_handler_returns_what_the_contract_says(endpoint: Endpoint[Any]) -> None:
    returned = get_type_hints(HANDLERS[endpoint.name])["return"]
    if returned is Response:
        assert endpoint.answer is NoneType
    else:
        assert returned == endpoint.answer
        assert endpoint.media_types == (JSON,)


def test_an_endpoint_without_a_handler_is_an_error() -> None:
    with pytest.raises(KeyError, match="fly_away"):
        find_handlers([Endpoint("fly_away", "POST", "/fly", "operate", "Fly away", NoneType)])


def test_no_handler_is_forgotten_in_the_contract() -> None:
    found = {
        name
        for module in list_modules()
        for name, each in vars(module).items()
        if name[0] != "_" and inspect.iscoroutinefunction(each) and list(inspect.signature(each).parameters) == ["call"]
    }
    assert found == {each.name for each in ENDPOINTS}
