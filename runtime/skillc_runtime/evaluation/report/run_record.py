"""What is known of a run when its report is made: its trees and choices, the samples, the world and ground truth."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf

import numpy as np

from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.evaluation.metrics.intervals import Interval
from skillc_runtime.evaluation.report.arm_trace import COLUMNS, ArmPath
from skillc_runtime.evaluation.report.choice_listener import ChoiceListener
from skillc_runtime.evaluation.report.handlings import Handling, find_handlings
from skillc_runtime.evaluation.report.run_trace import RunTrace
from skillc_runtime.evaluation.report.wiping import Wiping, find_wipings
from skillc_runtime.recording.node_outcome import NodeOutcome
from skillc_runtime.world.state.terms import ARM_DEVICE, CONTAIN, FORCE_TORQUE_SENSOR, HAS_GRIPPER, HAS_SENSOR
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True)
class RunRecord:
    """The trees of all attempts with the chosen implementations, the world model at the end, the truth, and samples.

    `truth` is None where it is not known: then only what devices measure is reported.
    """

    trees: Sequence[NodeOutcome]
    choices: ChoiceListener
    state: WorldState
    truth: GroundTruth | None
    trace: RunTrace

    @cached_property
    def wipings(self) -> tuple[Wiping, ...]:
        """The last wiping of each surface."""
        return find_wipings(self.trees, self.choices, self.state)

    @cached_property
    def handlings(self) -> tuple[Handling, ...]:
        """What was picked up, in order of time."""
        return find_handlings(self.trees, self.choices, self.state)

    def arm_path(self, arm: str) -> ArmPath:
        """Return the samples of an arm; none if the cell has no such arm."""
        try:
            return self.trace.arms.path(arm)
        except KeyError:
            return ArmPath(np.empty((0, COLUMNS)))

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

    def runs_of(self, node: NodeOutcome) -> tuple[Interval, ...]:
        """Return start and end in s of each run of a node that succeeded, and of its last one, however it ended."""
        runs = set(self.choices.runs.get(node.id, []))
        if node.started is not None:
            runs.add((node.started, self.end_s if node.ended is None else node.ended))
        return tuple(sorted(runs))

    @cached_property
    def end_s(self) -> float:
        """When the last sample was taken, in s."""
        paths = (self.arm_path(arm).time for arm in sorted(self.state.instances(ARM_DEVICE)))
        return max((float(time[-1]) for time in paths if len(time)), default=0.0)
