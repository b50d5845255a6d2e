"""A server that the tests of this folder share; each leaves no operation behind that goes on."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from server.running import RunningServer, serving


@pytest.fixture(scope="package")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    with serving(tmp_path_factory.mktemp("server")) as running:
        yield running
