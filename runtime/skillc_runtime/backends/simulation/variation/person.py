"""A simulated person who guides a released tool by hand to a goal."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf, sqrt
from typing import Any

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.arms.arm import ModelledArm
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.people import PersonSpec, PersonVariation
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.backends.simulation.steps import OnMemory
from skillc_runtime.backends.simulation.variation.variation import Variation
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.motion.arrays import OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import bind, compiled
from skillc_runtime.motion.numerics.linear import cross, squared, times
from skillc_runtime.motion.pose import Array, Pose

REACTION_S = 1.0
"""Time until a person notices that the arm is released."""

PULL_N_M, HOLD_N_S_M = 150.0, 40.0
"""Stiffness and damping with which a person pulls the tool to the goal, up to their greatest force."""

THERE_M, THERE_S = 0.002, 1.0
"""The person lets go when the tool has been this close to the goal for this time."""

SOME_STEPS = 1 << 12
"""For how many steps of guiding there is room at first."""

YIELDS_SINCE, THERE_SINCE, HAS_LET_GO, STEPS = range(4)
"""Entries of `PersonMemory.mind`: s, since when the arm yields and the tool is there, infinite while not; 1 once the
person has let go; steps in which they guided."""


class PersonMemory(msgspec.Struct, frozen=True):
    """What a person feels, knows and does.

    stiffness (6,): N/m and N m/rad, that the arm is to have; tool: in base, and its velocity (3,) in m/s; base: in the
    world. place (3,): m, where the tool is to be; centre (3,): m, of the hand's mass; force (6,): N and N m, on it; all
    in the world. strength_n: N, the greatest force. mind (4,): see above; guided (n, 2): s and N, a row for each step.
    """

    stiffness: Vector
    tool: Pose
    velocity: Vector
    base: Pose
    place: Vector
    centre: Vector
    force: OutVector
    strength_n: float
    mind: OutVector
    guided: OutMatrix


@compiled
def guide(person: PersonMemory, now: float) -> int:
    """Apply the force of the step that begins at `now` s; return 1, and do nothing, if there is no room for it."""
    mind, force, stiffness = person.mind, person.force, person.stiffness
    if int(mind[STEPS]) == person.guided.shape[0]:
        return 1
    for i in range(6):
        force[i] = 0.0
    yields = stiffness[0] == 0.0 and stiffness[1] == 0.0 and stiffness[2] == 0.0
    mind[YIELDS_SINCE] = min(mind[YIELDS_SINCE], now) if yields else inf
    if now - mind[YIELDS_SINCE] < REACTION_S or mind[HAS_LET_GO] != 0.0 or not yields:
        return 0
    away, lever, moment = np.empty(3), np.empty(3), np.empty(3)
    times(person.base.rotation, person.tool.position, lever)
    times(person.base.rotation, person.velocity, force[:3])
    for i in range(3):
        lever[i] += person.base.position[i]
        away[i] = person.place[i] - lever[i]
        lever[i] -= person.centre[i]
    far = sqrt(squared(away))
    share = min(1.0, person.strength_n / max(PULL_N_M * far, 1e-9))
    for i in range(3):
        force[i] = share * PULL_N_M * away[i] - HOLD_N_S_M * force[i]
    cross(lever, force[:3], moment)
    for i in range(3):
        force[3 + i] = moment[i]
    row = int(mind[STEPS])
    person.guided[row, 0], person.guided[row, 1] = now, sqrt(squared(force[:3]))
    mind[STEPS] += 1.0
    mind[THERE_SINCE] = min(mind[THERE_SINCE], now) if far < THERE_M else inf
    if now - mind[THERE_SINCE] >= THERE_S:
        mind[HAS_LET_GO] = 1.0
    return 0


class SimulatedPerson(OnMemory):
    """Acts on the hand of one arm in every step; `place` (3,) in m is the goal of the tool in the world."""

    def __init__(
        self, facts: PersonSpec, true: PersonVariation, hand: str, arm: ModelledArm, driver: CompliantArmDriver,
        data: Any,
    ) -> None:  # fmt: skip
        body = data.body(hand)
        self.arm = facts.arm
        self.place: Array = facts.place + np.array(true.place_m)
        self._guided, self._mind = np.empty((SOME_STEPS, 2)), np.array([inf, inf, 0.0, 0.0])
        self._felt = driver.compliance.live_stiffness, driver.measured.state.tool, arm.live_velocity, arm.live_base
        self._acts_on = self.place, body.xipos, body.xfrc_applied, true.strength_n
        super().__init__(self._bind())

    @property
    def guided(self) -> Array:
        """When they guided the tool, in s, and with which force, in N: a row (2,) for each step; a copy."""
        return self._guided[: int(self._mind[STEPS])].copy()

    def act(self, events: int, now: float) -> bool:
        """Make room, and apply the force of the step."""
        self._guided = np.concatenate([self._guided, np.empty_like(self._guided)])
        self._compute = self._bind()
        self.step(now)
        return True

    def _bind(self) -> Any:
        return bind(guide, PersonMemory(*self._felt, *self._acts_on, self._mind, self._guided))


def make_people(
    scene: SceneSpec, variation: Variation, arms: Mapping[str, ModelledArm], drivers: Mapping[str, CompliantArmDriver],
    data: Any,
) -> tuple[SimulatedPerson, ...]:  # fmt: skip
    """Return the people who are present and guide an arm with a gripper."""
    hands = {arm.individual: palm for arm in scene.arms if (palm := _palm(arm, scene.names)) is not None}
    return tuple(
        SimulatedPerson(each, true, hands[each.arm], arms[each.arm], drivers[each.arm], data)
        for each, true in zip(scene.people, variation.people, strict=True)
        if true.present and each.arm in hands
    )


def _palm(arm: ArmSpec, names: Mapping[str, str]) -> str | None:
    return None if arm.gripper is None else part_name(names[arm.gripper.individual], "palm")
