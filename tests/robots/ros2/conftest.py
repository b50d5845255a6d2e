"""What all tests with ROS 2 need: its packages, and a domain on loopback."""

from __future__ import annotations

import os
from collections.abc import Iterator
from importlib.util import find_spec
from typing import Any

import pytest

from robots.ros2.running import LOOPBACK


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if "robots/ros2" in item.nodeid:
            item.add_marker(pytest.mark.robot)
            if find_spec("rclpy") is None:
                item.add_marker(pytest.mark.skip(reason="there is no ROS 2: pip install 'skillc[ros2]'"))


@pytest.fixture(autouse=True, scope="session")
def _on_loopback() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        for name, value in LOOPBACK.items():
            patch.setenv(name, value)
        yield
    assert os.environ.get("ROS_DOMAIN_ID") != LOOPBACK["ROS_DOMAIN_ID"]


@pytest.fixture
def other() -> Iterator[Any]:
    """Return a node beside those of the back end."""
    from skillc_runtime.backends.ros2.session import Session

    session = Session("other")
    yield session
    session.close()
