"""What moves in a cell at one instant, for displays: samples may be dropped, events never are."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
import numpy as np

from skillc_runtime.devices.live import LiveArm
from skillc_runtime.devices.simulation import Simulation
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation

PoseNumbers = tuple[float, float, float, float, float, float, float]
"""A pose in the world: position in m, then the unit quaternion (w, x, y, z)."""


class ArmSample(msgspec.Struct, frozen=True):
    """An arm: joint angles in rad and speeds in rad/s, as measured last, and the poses of base and tool in the world.

    `wrench` is what a force-torque sensor measures on the tool, N and N m, in the arm's base frame; None without one.
    """

    joints: tuple[float, ...]
    speeds: tuple[float, ...]
    base: PoseNumbers
    tool: PoseNumbers
    wrench: tuple[float, float, float, float, float, float] | None = None


class Sample(msgspec.Struct, frozen=True):
    """A simulated cell at `time_s` of its clock: its arms, and where things really are in the world, both by IRI."""

    cell: str
    time_s: float
    arms: dict[str, ArmSample]
    things: dict[str, PoseNumbers]


class Sampler:
    """Takes samples of a cell between its ticks; that costs nothing while nobody wants one."""

    def __init__(self, name: str, simulation: Simulation) -> None:
        self._name, self._simulation = name, simulation
        self._things: tuple[str, ...] | None = None

    def take(self) -> Sample:
        """Return the present instant."""
        if self._things is None:
            self._things = tuple(self._find_things())
        simulation, truth = self._simulation, self._simulation.ground_truth
        return Sample(
            cell=self._name,
            time_s=simulation.clock.now,
            arms={each.individual: self._sample_arm(each) for each in simulation.live.arms},
            things={each: _list_numbers(truth.body_pose(each)) for each in self._things},
        )

    def _find_things(self) -> Iterator[str]:
        """Yield what has a true pose, in order of IRI."""
        for each in sorted(self._simulation.cell.world.snapshot().individuals):
            try:
                self._simulation.ground_truth.body_pose(each)
            except KeyError:
                continue
            yield each

    def _sample_arm(self, arm: LiveArm) -> ArmSample:
        joints, speeds = np.frombuffer(arm.measured()).reshape(2, arm.joints).tolist()
        wrench = None if arm.wrench is None else tuple(np.frombuffer(arm.wrench()).tolist())
        tool = self._simulation.cell.arm(arm.individual).measured.pose
        return ArmSample(tuple(joints), tuple(speeds), _list_numbers(arm.base()), _list_numbers(tool), wrench)


def _list_numbers(pose: Pose) -> PoseNumbers:
    x, y, z = pose.position.tolist()
    return (x, y, z, *quaternion_from_rotation(pose.rotation).tolist())
