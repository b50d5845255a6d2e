"""The conformance suite of back ends, against a robot that others simulate."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from backends.backend import MakeBackend
from backends.remote import CONFORMANCE, RemoteBackend
from backends.test_conformance import *  # noqa: F403
from robots.franka.cells import ARM, own_scene
from robots.franka.running import Peer, proxy
from skillc_runtime.backends.control_process.opening import open_cell
from skillc_runtime.backends.franka.cell import describe
from skillc_runtime.motion.pose import Array

pytestmark = [pytest.mark.robot, pytest.mark.long]

HOME = np.array([0.0, -0.3, 0.0, -2.1, 0.0, 1.8, 0.785])


class PeersSurroundings:
    """Implements `Surroundings`; the base of the arm is not turned in its scene."""

    home = HOME

    def __init__(self, simulated: Peer, between: Peer) -> None:
        self._simulated, self._between = simulated, between

    def put_wall(self, gap_m: float) -> Array:
        return np.array(self._simulated.ask(f"wall {gap_m}"))

    def remove_wall(self) -> None:
        self._simulated.ask("no-wall")

    def wall_force_n(self) -> float:
        return float(self._simulated.ask("wall-force"))

    def violations(self) -> Sequence[str]:
        found: list[str] = self._between.ask("report")["violations"]
        return found


@pytest.fixture(scope="module")
def make(simulated: Peer, tmp_path_factory: pytest.TempPathFactory) -> Iterator[MakeBackend]:
    folder: Path = tmp_path_factory.mktemp("cell")
    with proxy(simulated) as between:
        cell = open_cell(own_scene("sorting", "sort_parts", between.address, folder), describe, patience=CONFORMANCE)
        yield partial(RemoteBackend, cell, ARM, PeersSurroundings(simulated, between))
        cell.close()
