"""A simulated person who guides a released tool by hand to a goal."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.people import PersonSpec, PersonVariation
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.backends.simulation.variation import Variation
from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.motion.pose import Array

REACTION_S = 1.0
"""Time until a person notices that the arm is released."""

PULL_N_M, HOLD_N_S_M = 150.0, 40.0
"""Stiffness and damping with which a person pulls the tool to the goal, up to their greatest force."""

THERE_M, THERE_S = 0.002, 1.0
"""The person lets go when the tool has been this close to the goal for this time."""


class SimulatedPerson:
    """Acts on the hand of one arm in every step; `place` (3,) in m is the goal of the tool in the world.

    forces, times: N and s, one for each step in which they guide the tool.
    """

    def __init__(self, facts: PersonSpec, true: PersonVariation, hand: str, driver: ArmDriver, data: Any) -> None:
        body = data.body(hand)
        self.arm = facts.arm
        self._force, self._centre, self._driver = body.xfrc_applied, body.xipos, driver
        self.place: Array = facts.place + np.array(true.place_m)
        self._strength = true.strength_n
        self._yields_since: float | None = None
        self._there_since: float | None = None
        self.forces: list[float] = []
        self.times: list[float] = []
        self.let_go = False

    def step(self, now: float) -> None:
        """Apply the force of one step at `now` s."""
        yields = not self._driver.compliance.commanded_stiffness[:3].any()
        self._yields_since = None if not yields else now if self._yields_since is None else self._yields_since
        leading = self._yields_since is not None and now - self._yields_since >= REACTION_S and not self.let_go
        self._force[:] = 0.0
        if leading:
            self._guide(now)

    def _guide(self, now: float) -> None:
        tool = self._driver.measured.pose.position
        away = self.place - tool
        pull = PULL_N_M * away
        pull *= min(1.0, self._strength / max(float(np.linalg.norm(pull)), 1e-9))
        self._force[:3] = pull - HOLD_N_S_M * self._driver.measured.velocity[:3]
        self._force[3:] = np.cross(tool - self._centre, self._force[:3])
        self.forces.append(float(np.linalg.norm(self._force[:3])))
        self.times.append(now)
        near = float(np.linalg.norm(away)) < THERE_M
        self._there_since = None if not near else now if self._there_since is None else self._there_since
        self.let_go = self._there_since is not None and now - self._there_since >= THERE_S


def make_people(
    scene: SceneSpec, variation: Variation, drivers: Mapping[str, ArmDriver], data: Any
) -> tuple[SimulatedPerson, ...]:
    """Return the people who are present and guide an arm with a gripper."""
    hands = {arm.individual: palm for arm in scene.arms if (palm := _palm(arm, scene.names)) is not None}
    return tuple(
        SimulatedPerson(each, true, hands[each.arm], drivers[each.arm], data)
        for each, true in zip(scene.people, variation.people, strict=True)
        if true.present and each.arm in hands
    )


def _palm(arm: ArmSpec, names: Mapping[str, str]) -> str | None:
    return None if arm.gripper is None else part_name(names[arm.gripper.individual], "palm")
