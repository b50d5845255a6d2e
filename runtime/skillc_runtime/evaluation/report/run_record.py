"""What is known of a run when its report is made: its history, the samples, the world and ground truth."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import inf

import numpy as np

from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.evaluation.report.handlings import Handling, find_handlings
from skillc_runtime.evaluation.report.run_trace import ARM_COLUMNS, ArmPath, RunTrace
from skillc_runtime.evaluation.report.wiping import Wiping, WipingDrawing, find_recorded_wipings, make_wiping_drawing
from skillc_runtime.recording.history.history import RunHistory
from skillc_runtime.world.state.terms import ARM_DEVICE, CONTAIN, FORCE_TORQUE_SENSOR, HAS_GRIPPER, HAS_SENSOR
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True)
class RunRecord:
    """The history of a run, the world model at its end, the truth, and samples.

    `truth` is None where it is not known: then only what devices measure is reported.
    """

    history: RunHistory
    state: WorldState
    truth: GroundTruth | None
    trace: RunTrace

    @cached_property
    def wipings(self) -> tuple[Wiping, ...]:
        """The wipings of surfaces, in order of time."""
        return find_recorded_wipings(self.history, self.state, self.truth)

    @cached_property
    def wiping_drawings(self) -> tuple[WipingDrawing, ...]:
        """What is drawn of the wipings; nothing without the truth."""
        truth = self.truth
        return () if truth is None else tuple(make_wiping_drawing(each, self.state, truth) for each in self.wipings)

    @cached_property
    def handlings(self) -> tuple[Handling, ...]:
        """What was picked up, in order of time."""
        return find_handlings(self.history, self.state)

    def arm_path(self, arm: str) -> ArmPath:
        """Return the samples of an arm; none if the cell has no such arm."""
        try:
            return self.trace.arms.path(arm)
        except KeyError:
            return ArmPath(np.empty((0, ARM_COLUMNS)))

    def has_force_sensor(self, arm: str) -> bool:
        """Whether an arm has a force-torque sensor."""
        return any(self.state.is_a(each, FORCE_TORQUE_SENSOR) for each in self.state.objects(arm, HAS_SENSOR))

    def held_by(self, arm: str, start: float, end: float) -> Iterator[str]:
        """Yield what an arm may have held in an interval in s: what it picked up, and what it holds at the end."""
        grippers = sorted(self.state.objects(arm, HAS_GRIPPER))
        for each in self.handlings:
            if each.gripper in grippers and each.grasped_s < end and (each.released_s or inf) > start:
                yield each.thing
        yield from (thing for gripper in grippers for thing in sorted(self.state.objects(gripper, CONTAIN)))

    @cached_property
    def end_s(self) -> float:
        """When the last sample was taken, in s."""
        paths = (self.arm_path(arm).time for arm in sorted(self.state.instances(ARM_DEVICE)))
        return max((float(time[-1]) for time in paths if len(time)), default=0.0)
