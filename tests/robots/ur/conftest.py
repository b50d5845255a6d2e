"""The controller that tests of single devices share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from robots.ur.peer import Peer, running_peer


@pytest.fixture(scope="session")
def controller() -> Iterator[Peer]:
    """A controller with a gripper, which both kinds of sockets move."""
    with running_peer("--unlock", "0.1") as running:
        yield running


@pytest.fixture
def peer(controller: Peer) -> Iterator[Peer]:
    """The controller, in order before and after; nothing may have been commanded beyond its limits."""
    yield controller
    controller.do("release")
    assert controller.tell()["violations"] == []
