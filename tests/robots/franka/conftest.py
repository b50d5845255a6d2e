"""The robot of the tests, which needs packages that not everybody installs."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from robots.franka.running import Peer, proxy, robot

pytest.importorskip("franky_sim", reason="the robot of these tests is franky-sim: pip install franky-sim")
pytest.importorskip("pylibfranka", reason="the back end `franka` needs pylibfranka: pip install 'skillc[franka]'")


@pytest.fixture(scope="module")
def simulated() -> Iterator[Peer]:
    """A robot with nothing around it."""
    with robot() as peer:
        yield peer


@pytest.fixture
def before(simulated: Peer) -> Iterator[Peer]:
    """A proxy before that robot; clients connect to its address."""
    with proxy(simulated) as peer:
        yield peer
