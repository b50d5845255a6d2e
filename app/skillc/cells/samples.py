"""What moves in a cell at one instant, for displays: samples may be dropped, events never are."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from skillc.contract.sample import ArmSample, ForceSample, PoseNumbers, Sample
from skillc_runtime.devices.live import LiveArm, LiveSensors
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation, rotation_from_quaternion

if TYPE_CHECKING:
    from skillc_runtime.devices.simulation import Simulation


FEWEST_N = 0.05
"""Weaker contact forces are left out."""


class Sampler:
    """Takes samples of a cell between its ticks; that costs nothing while nobody wants one."""

    def __init__(self, name: str, simulation: Simulation) -> None:
        self._name, self._simulation = name, simulation
        self._poses: dict[str, Callable[[], Pose]] | None = None
        self._joints = dict(_find_joints(simulation))

    def take(self) -> Sample:
        """Return the present instant."""
        if self._poses is None:
            self._poses = dict(self._find_poses())
        simulation, positions = self._simulation, self._simulation.drawing.posture().joints.tolist()
        return Sample(
            cell=self._name,
            time_s=simulation.clock.now,
            arms={each.individual: self._sample_arm(each) for each in simulation.live.arms},
            things={each: list_numbers(read()) for each, read in self._poses.items()},
            joints={name: positions[address] for name, address in self._joints.items()},
            forces=dict(_sample_forces(simulation.live.sensors)),
        )

    def _find_poses(self) -> Iterator[tuple[str, Callable[[], Pose]]]:
        """Yield what has a true pose in order of IRI, bases among it, and how to read that."""
        cell, truth = self._simulation.cell, self._simulation.ground_truth
        for each in sorted(cell.world.snapshot().individuals):
            for read in (truth.body_pose, lambda base: cell.base(base).pose):
                with suppress(KeyError):
                    read(each)
                    yield each, partial(read, each)
                    break

    def _sample_arm(self, arm: LiveArm) -> ArmSample:
        joints, speeds = np.frombuffer(arm.measured()).reshape(2, arm.joints).tolist()
        wrench = None if arm.wrench is None else tuple(np.frombuffer(arm.wrench()).tolist())
        tool = self._simulation.cell.arm(arm.individual).measured.pose
        return ArmSample(tuple(joints), tuple(speeds), list_numbers(arm.base()), list_numbers(tool), wrench)


def _find_joints(simulation: Simulation) -> Iterator[tuple[str, int]]:
    """Yield the name of each joint with one position that is not an arm's, and where that is among all positions."""
    drawing = simulation.drawing
    arms = tuple(drawing.prefixes[each.individual] for each in simulation.live.arms)
    for number in range(drawing.model.njnt):
        joint = drawing.model.joint(number)
        if len(joint.qpos0) == 1 and not joint.name.startswith(arms):
            yield joint.name, int(joint.qposadr[0])


def _sample_forces(sensors: LiveSensors) -> Iterator[tuple[str, ForceSample]]:
    """Yield the tools whose working faces are pressed; a face pushes back along its z axis."""
    values = np.frombuffer(sensors.read())
    for tool, first in sensors.faces:
        force = abs(float(values[first]))
        if force >= FEWEST_N:
            x, y, z = values[first + 1 : first + 4].tolist()
            inward = -force * rotation_from_quaternion(values[first + 4 : first + 8])[:, 2]
            fx, fy, fz = inward.tolist()
            yield tool, ForceSample((fx, fy, fz), (x, y, z))


def list_numbers(pose: Pose) -> PoseNumbers:
    """Return the numbers of a pose."""
    x, y, z = pose.position.tolist()
    return (x, y, z, *quaternion_from_rotation(pose.rotation).tolist())
