"""Fixtures in the simulation: where they really stand, their models, and what they report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Pose, quaternion_of
from skillc_runtime.simulation.fixture_facts import FixtureFacts
from skillc_runtime.simulation.names import part
from skillc_runtime.simulation.variation import chance_of


def true_pose(fixture: FixtureFacts, seed: int) -> Pose:
    """Return where a fixture really stands: anywhere on a disc across its axis, and along the axis, evenly."""
    chance = chance_of(fixture.individual, seed)
    away = fixture.place_range_m * float(np.sqrt(chance.uniform()))
    towards, along = float(chance.uniform(0.0, 2 * np.pi)), float(chance.uniform(-1.0, 1.0))
    beside = np.array([away * np.cos(towards), away * np.sin(towards), along * fixture.depth_range_m])
    return fixture.pose @ Pose(beside, np.eye(3))


def displaced(fixture: FixtureFacts, seed: int) -> str:
    """Say how far a fixture really stands from where it is believed to."""
    x, y, z = 1e3 * (fixture.pose.inverse() @ true_pose(fixture, seed)).position
    return f"{np.hypot(x, y):.1f} mm beside and {z:+.1f} mm along its axis"


def add_fixture(spec: Any, name: str, fixture: FixtureFacts, seed: int) -> None:
    """Attach the model of a fixture to the world where the fixture really stands."""
    model, pose = mujoco.MjSpec.from_file(str(fixture.model)), true_pose(fixture, seed)
    frame = spec.worldbody.add_frame(pos=pose.position, quat=quaternion_of(pose.rotation))
    spec.attach(model, prefix=part(name, ""), frame=frame)


class SimulatedButton:
    """A button of a simulated cell, implementing `Button`; its model has the sensor `travel` in m."""

    def __init__(self, name: str, switch_travel_m: float, data: Any) -> None:
        self._travel, self._switches_at = data.sensor(part(name, "travel")).data, switch_travel_m

    @property
    def switched(self) -> bool:
        """Whether the cap is in far enough."""
        return bool(self._travel[0] >= self._switches_at)


def buttons(fixtures: Sequence[FixtureFacts], names: Mapping[str, str], data: Any) -> dict[str, SimulatedButton]:
    """Return those of the fixtures that are buttons, by IRI."""
    return {
        each.individual: SimulatedButton(names[each.individual], each.switch_travel_m, data)
        for each in fixtures
        if each.switch_travel_m is not None
    }
