"""A short series of random requests; `make soak` sends a long one."""

from __future__ import annotations

from pathlib import Path

import pytest

from random_requests.sending import send_requests
from server.running import serving


@pytest.mark.sim
def test_random_requests_are_answered_as_the_document_says(tmp_path: Path) -> None:
    with serving(tmp_path) as server:
        answers = send_requests(server, tmp_path, examples=8, seed=1)
        documented = sum(map(len, server.client.get("/openapi.json").json()["paths"].values()))
        cell = server.client.get("/cells/yard").json()
        assert cell["state"] in ("operational", "emergency-stop"), "that one is pressed by systematic requests"
    assert answers.faults == ()
    assert answers.operations == documented - 1, "each but that which returns the document"
    assert max(answers.statuses) < 500 and {200, 201, 204, 404, 409, 422} <= answers.statuses.keys()
    assert answers.statuses.total() > 30 * documented
