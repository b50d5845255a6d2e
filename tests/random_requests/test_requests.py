"""A short series of random requests; `make soak` sends a long one."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from random_requests.sending import send_requests
from server.running import serving


def find_schemas(part: Any) -> Iterator[Any]:
    """Yield the schemas of bodies and answers in an OpenAPI document."""
    if isinstance(part, dict):
        yield from (value for name, value in part.items() if name == "schema")
        part = list(part.values())
    if isinstance(part, list):
        for each in part:
            yield from find_schemas(each)


@pytest.mark.early
@pytest.mark.sim
def test_random_requests_are_answered_as_the_document_says(tmp_path: Path) -> None:
    with serving(tmp_path) as server:
        answers = send_requests(server, tmp_path, examples=8, seed=1)
        document = server.client.get("/openapi.json").json()
        documented = sum(map(len, document["paths"].values()))
        cell = server.client.get("/cells/yard").json()
        assert cell["state"] in ("operational", "emergency-stop"), "that one is pressed by systematic requests"
    for each in find_schemas(document):
        Draft202012Validator.check_schema(each)
    assert answers.faults == ()
    assert answers.operations >= documented - 2, "each but that which returns the document, and one that is misread"
    assert max(answers.statuses) < 500 and {200, 201, 204, 404, 409, 422} <= answers.statuses.keys()
    assert answers.statuses.total() > 30 * documented
