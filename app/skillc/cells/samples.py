"""What moves in a cell at one instant, for displays: samples may be dropped, events never are."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from skillc.contract.sample import ArmSample, ForceSample, PoseNumbers, Sample, Vector
from skillc_runtime.devices.live import LiveArm, LiveSensors
from skillc_runtime.motion.pose import Array, Pose, rotation_from_quaternion

if TYPE_CHECKING:
    from skillc_runtime.devices.backend import Backend
    from skillc_runtime.devices.control_report import ControlReport
    from skillc_runtime.devices.drawing import Drawing
    from skillc_runtime.devices.live import LiveSignals


FEWEST_N = 0.05
"""Weaker contact forces are left out."""


class Sampler:
    """Takes samples of a cell between its ticks; that costs nothing while nobody wants one."""

    def __init__(self, name: str, backend: Backend) -> None:
        self._name, self._backend = name, backend
        self._poses: dict[str, Callable[[], Pose]] | None = None
        self._live, self._drawing = backend.capabilities.live, backend.capabilities.drawing
        self._joints = dict(_find_joints(self._drawing, self._live))
        self._drawn = {} if self._drawing is None else dict(_find_placed(self._drawing))

    def take(self) -> Sample:
        """Return the present instant."""
        if self._poses is None:
            self._poses = dict(self._find_poses())
        if self._live is not None:
            self._live.refresh()
        positions = () if self._drawing is None else self._drawing.posture().joints.tolist()
        live_arms = () if self._live is None else self._live.arms
        return Sample(
            cell=self._name,
            time_s=self._backend.clock.now,
            arms={each.individual: self._sample_arm(each) for each in live_arms},
            things={each: read().numbers for each, read in self._poses.items()} | dict(self._sample_drawn()),
            joints={name: positions[address] for name, address in self._joints.items()},
            forces={} if self._live is None else dict(_sample_forces(self._live.sensors)),
        )

    def read_controls(self) -> dict[str, ControlReport]:
        """Return the reports of the processes that control real arms, by IRI."""
        if self._live is None:
            return {}
        self._live.refresh()
        return {each.individual: each.control() for each in self._live.arms if each.control is not None}

    def _find_poses(self) -> Iterator[tuple[str, Callable[[], Pose]]]:
        """Yield what has a true pose, or a base that reports its own, in order of IRI, and how to read that."""
        cell, truth = self._backend.cell, self._backend.capabilities.truth
        reads: list[Callable[[str], Pose]] = [lambda base: cell.base(base).pose]
        if truth is not None:
            reads.insert(0, truth.body_pose)
        for each in sorted(cell.world.snapshot().individuals):
            for read in reads:
                with suppress(KeyError):
                    read(each)
                    yield each, partial(read, each)
                    break

    def _sample_drawn(self) -> Iterator[tuple[str, PoseNumbers]]:
        """Yield where things are drawn in a cell without truth, which is where hands or the world model have them."""
        drawing, live = self._drawing, self._live
        if drawing is None or live is None or self._backend.capabilities.truth is not None:
            return
        positions = np.frombuffer(live.bodies.positions()).reshape(-1, 3)
        quaternions = np.frombuffer(live.bodies.quaternions()).reshape(-1, 4)
        for each, number in self._drawn.items():
            (x, y, z), (w, a, b, c) = positions[number].tolist(), quaternions[number].tolist()
            yield each, (x, y, z, w, a, b, c)

    def _sample_arm(self, arm: LiveArm) -> ArmSample:
        joints, speeds = np.frombuffer(arm.measured()).reshape(2, arm.joints).tolist()
        wrench = None if arm.wrench is None else tuple(np.frombuffer(arm.wrench()).tolist())
        driver = self._backend.cell.arm(arm.individual)
        poses = arm.base().numbers, driver.measured.pose.numbers
        velocities = _list_vector(driver.measured.velocity), _list_vector(driver.motion.reference.twist)
        force = driver.compliance.commanded_force
        pushed = None if np.isnan(force).any() else _list_vector(force)
        control = None if arm.control is None else arm.control()
        is_commanded = control is not None and control.state == "in-control"
        reference = driver.motion.reference.pose.numbers if is_commanded else None
        return ArmSample(tuple(joints), tuple(speeds), *poses, wrench, *velocities, pushed, reference, control)


def _list_vector(values: Array) -> Vector:
    """Return the first three values: of a twist or a wrench, the linear half."""
    x, y, z = values[:3].tolist()
    return x, y, z


def _find_joints(drawing: Drawing | None, live: LiveSignals | None) -> Iterator[tuple[str, int]]:
    """Yield the name of each joint with one position that is not an arm's, and where that is among all positions."""
    if drawing is None or live is None:
        return
    arms = tuple(drawing.prefixes[each.individual] for each in live.arms)
    for number in range(drawing.model.njnt):
        joint = drawing.model.joint(number)
        if len(joint.qpos0) == 1 and not joint.name.startswith(arms):
            yield joint.name, int(joint.qposadr[0])


def _find_placed(drawing: Drawing) -> Iterator[tuple[str, int]]:
    """Yield what neither arms nor bases move by themselves, and the number of its body."""
    for individual, each in drawing.individuals.items():
        if each.kind not in ("arm", "gripper", "base"):
            yield individual, int(drawing.model.body(each.body).id)


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
