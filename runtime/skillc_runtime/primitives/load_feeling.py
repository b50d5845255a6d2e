"""Gathers what an arm at rest feels of its load, in one posture after the other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.payload_estimation import (
    UNKNOWN,
    LinkSample,
    LoadSample,
    PayloadError,
    estimate_by_links,
    estimate_by_wrist,
)

if TYPE_CHECKING:
    from skillc_runtime.devices.arm_driver import ArmDriver

SETTLING_S, AVERAGING_S = 0.3, 0.6
"""How long an arm stands still before it feels a load, and how long that is averaged, in s."""


class LoadFeeling:
    """Feels the load of one arm: by the torques of its links if it measures these, else by its wrist."""

    def __init__(self, arm: ArmDriver) -> None:
        self._arm = arm
        self._by_links, self._by_wrist = list[LinkSample](), list[LoadSample]()
        self._still_since: float | None = None
        self._felt: list[Array] = []

    @property
    def is_possible(self) -> bool:
        """Whether the arm feels loads."""
        return self._arm.measured.link_torque is not None or self._arm.measured.felt is not None

    @property
    def count(self) -> int:
        """In how many postures a load was felt."""
        return len(self._by_links) + len(self._by_wrist)

    def start_again(self) -> None:
        """Forget what was felt in the present posture."""
        self._still_since, self._felt = None, []

    def feel(self, now: float) -> bool:
        """Feel at `now` s, in a tick; return whether that is enough for this posture."""
        if not self._arm.measured.still or self._still_since is None:
            self._still_since, self._felt = now, []
        resting_s = now - self._still_since
        if resting_s >= SETTLING_S:
            links = self._arm.measured.link_torque
            self._felt.append(self._arm.measured.wrench if links is None else links.torque)
        if resting_s < SETTLING_S + AVERAGING_S:
            return False
        self._keep(np.mean(self._felt, axis=0), now)
        self.start_again()
        return True

    def estimate(self) -> PayloadError:
        """Return by how much the load differs from what the arm counts with; its condition is infinite if unknown."""
        if self._by_links:
            return estimate_by_links(self._by_links, self._arm.limits.effort)
        if self._by_wrist:
            return estimate_by_wrist(self._by_wrist)
        return UNKNOWN

    def _keep(self, mean: Array, now: float) -> None:
        links, rotation = self._arm.measured.link_torque, self._arm.measured.pose.rotation
        if links is None:
            self._by_wrist.append(LoadSample(rotation, mean, now - AVERAGING_S / 2))
        else:
            self._by_links.append(LinkSample(rotation, mean, links.own, links.jacobian))
