"""A simulated person who takes a yielding tool by the hand and leads it to where they want it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.robots.driver import ArmDriver
from skillc_runtime.simulation.facts import ArmFacts
from skillc_runtime.simulation.names import part
from skillc_runtime.simulation.variation import chance_of
from skillc_runtime.world.frames import pose
from skillc_runtime.world.sheet import number
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.terms import LEAD_RANGE, LEADS, PERSON

REACTION_S = 1.0
"""How long a person takes to notice that the arm yields."""

PULL_N_M, HOLD_N_S_M, STRENGTH_N = 150.0, 40.0, 15.0
"""A person pulls the more the farther it is, up to a strength, and lets nothing swing."""

THERE_M, THERE_S = 0.002, 1.0
"""This near, for that long, is there: the person lets go."""


@dataclass(frozen=True, slots=True)
class PersonFacts:
    """A person: the arm they lead, where they want its tool in the world (3,) m, and how far beside that it may be."""

    individual: str
    arm: str
    place: Array
    range_m: float


def read_people(state: WorldState) -> tuple[PersonFacts, ...]:
    """Read all people in order of IRI; SheetError or FrameError name the fact that is missing."""
    return tuple(
        PersonFacts(each, arm, pose(state, each).position, number(state, each, LEAD_RANGE, default=0.0))
        for each in sorted(state.instances(PERSON))
        for arm in sorted(state.objects(each, LEADS))
    )


class SimulatedPerson:
    """Acts on the hand of one arm, every step; `place` (3,) is where they want the tool."""

    def __init__(self, facts: PersonFacts, hand: str, driver: ArmDriver, data: Any, seed: int) -> None:
        body = data.body(hand)
        self._force, self._centre, self._driver = body.xfrc_applied, body.xipos, driver
        chance = chance_of(facts.individual, seed)
        self.place = facts.place + facts.range_m * chance.uniform(-1.0, 1.0, 3)
        self._yields_since: float | None = None
        self._there_since: float | None = None
        self.let_go = False

    def step(self, now: float) -> None:
        """Pull, or do not."""
        yields = not self._driver.commanded_stiffness[:3].any()
        self._yields_since = None if not yields else now if self._yields_since is None else self._yields_since
        leading = self._yields_since is not None and now - self._yields_since >= REACTION_S and not self.let_go
        self._force[:] = 0.0
        if leading:
            self._lead(now)

    def _lead(self, now: float) -> None:
        tool = self._driver.pose.position
        away = self.place - tool
        pull = PULL_N_M * away
        pull *= min(1.0, STRENGTH_N / max(float(np.linalg.norm(pull)), 1e-9))
        self._force[:3] = pull - HOLD_N_S_M * self._driver.velocity[:3]
        self._force[3:] = np.cross(tool - self._centre, self._force[:3])
        near = float(np.linalg.norm(away)) < THERE_M
        self._there_since = None if not near else now if self._there_since is None else self._there_since
        self.let_go = self._there_since is not None and now - self._there_since >= THERE_S


def people(
    facts: tuple[PersonFacts, ...],
    arms: tuple[ArmFacts, ...],
    names: Mapping[str, str],
    drivers: Mapping[str, ArmDriver],
    data: Any,
    seed: int,
) -> tuple[SimulatedPerson, ...]:
    """Return those who lead an arm that has a gripper to take hold of."""
    hands = {arm.individual: part(names[arm.gripper.individual], "palm") for arm in arms if arm.gripper is not None}
    return tuple(
        SimulatedPerson(each, hands[each.arm], drivers[each.arm], data, seed) for each in facts if each.arm in hands
    )
