"""What every back end must do, through topics of ROS 2."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import pytest

from backends.backend import MakeBackend
from backends.remote import CONFORMANCE, RemoteBackend
from backends.test_conformance import *  # noqa: F403  the tests of the suite and their fixture `backend`
from robots.ros2 import scenes
from robots.ros2.running import robot
from robots.ros2.test_cell import opened
from robots.ros2.test_link import IN_ROS
from robots.truth import RemoteTruth
from simulation.cells import ARM
from skillc_runtime.motion.pose import Array

pytestmark = [pytest.mark.slow, pytest.mark.long]


class Around:
    """Implements `Surroundings`."""

    def __init__(self, panel: RemoteTruth) -> None:
        self._panel, self.home = panel, panel.home()

    def put_wall(self, gap_m: float) -> Array:
        normal: Array = self._panel.put_wall(gap_m)
        return normal

    def remove_wall(self) -> None:
        self._panel.remove_wall()

    def wall_force_n(self) -> float:
        return float(self._panel.wall_force_n())

    def violations(self) -> Sequence[str]:
        found: list[str] = self._panel.violations()
        return found


@pytest.fixture(scope="module")
def make(tmp_path_factory: pytest.TempPathFactory) -> Iterator[MakeBackend]:
    folder = tmp_path_factory.mktemp("robot")
    scene, panel = scenes.whiteboard(folder), folder / "panel"
    with (
        robot(scene, folder, rate_hz=125, joint_names=IN_ROS, panel=str(panel)),
        opened(scene, CONFORMANCE) as cell,
    ):
        around = Around(RemoteTruth(panel, lambda: cell.now))
        yield partial(RemoteBackend, cell, ARM["ur5e_whiteboard"], around)
