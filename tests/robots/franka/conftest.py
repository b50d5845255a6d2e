"""The robot of the tests, which needs packages that not everybody installs."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from robots.franka.running import Peer, proxy, robot

NEEDED = {
    "franky_sim": "the robot of these tests is franky-sim: pip install franky-sim",
    "pylibfranka": "the back end `franka` needs pylibfranka: pip install 'skillc[franka]'",
}


@pytest.fixture(scope="module", autouse=True)
def installed(request: pytest.FixtureRequest) -> None:
    """Skip the tests of robots, and say why, where a package is missing."""
    if "robot" in {mark.name for mark in getattr(request.module, "pytestmark", ())}:
        for package, reason in NEEDED.items():
            pytest.importorskip(package, reason=reason)


@pytest.fixture(scope="module")
def simulated(installed: None) -> Iterator[Peer]:
    """A robot with nothing around it."""
    with robot() as peer:
        yield peer


@pytest.fixture
def before(simulated: Peer) -> Iterator[Peer]:
    """A proxy before that robot; clients connect to its address."""
    with proxy(simulated) as peer:
        yield peer
