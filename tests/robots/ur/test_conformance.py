"""What every back end must do, through the protocol of Universal Robots."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np
import pytest

from backends.backend import MakeBackend
from backends.remote import CONFORMANCE, RemoteBackend
from backends.test_conformance import *  # noqa: F403  the tests of the suite
from robots.ur.peer import Peer, running_peer
from robots.ur.tasks import ARM, HERE, PATIENT, facts_of, opened
from simulation.cells import vocabulary
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.motion.pose import Array
from skillc_runtime.scene.load import load_scene

pytest.importorskip("rtde_control", reason="ur-rtde is not installed: pip install 'skillc[ur]'")
pytestmark = [pytest.mark.robot, pytest.mark.long]


class UrSurroundings:
    """Implements `Surroundings`; `home` is a posture (6,) in rad."""

    def __init__(self, peer: Peer, home: Array) -> None:
        self._peer, self.home = peer, home

    def put_wall(self, gap_m: float) -> Array:
        return np.array(self._peer.do("wall", gap_m=gap_m))

    def remove_wall(self) -> None:
        self._peer.do("remove wall")

    def wall_force_n(self) -> float:
        return float(self._peer.do("wall force"))  # type: ignore[arg-type]

    def violations(self) -> Sequence[str]:
        found: list[str] = self._peer.tell()["violations"]
        return found


@pytest.fixture(scope="module")
def make() -> Iterator[MakeBackend]:
    """An arm of a controller that serves all tests."""
    scene = HERE / "whiteboard.ttl"
    with running_peer(*PATIENT, "--unlock", "0.1", scene=scene) as peer:
        state = load_scene(scene, vocabulary()).with_changes(facts_of(peer))
        with opened(peer, state, CONFORMANCE) as cell:
            yield partial(RemoteBackend, cell, ARM, UrSurroundings(peer, read_scene_spec(state).arms[0].home))
