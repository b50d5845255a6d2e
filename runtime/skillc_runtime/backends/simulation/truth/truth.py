"""The true state of a simulated cell, for reports and trials."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.button import SimulatedButton
from skillc_runtime.backends.simulation.hands.gripper import ModelledGripper
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.truth.observer import ToolObserver
from skillc_runtime.backends.simulation.truth.touch_recorder import TouchRecorder
from skillc_runtime.backends.simulation.variation.person import SimulatedPerson
from skillc_runtime.backends.simulation.variation.variation import Variation, exact_variation
from skillc_runtime.devices.ground_truth import Guidance, HandSample, Recording, Touching
from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.pose import Array, Pose


class SimulatedTruth(msgspec.Struct, frozen=True):
    """Implements `GroundTruth` from the parts of a simulated cell; mappings are by IRI."""

    scene: SceneSpec
    reality: Variation
    observers: Mapping[str, ToolObserver]
    covered: Mapping[str, CoverageMap]
    buttons: Mapping[str, SimulatedButton]
    people: Sequence[SimulatedPerson]
    touches: TouchRecorder
    grippers: Mapping[str, ModelledGripper]
    data: Any

    @property
    def seed(self) -> int:
        """The seed of the differences between reality and world model."""
        return self.reality.seed

    @property
    def variation(self) -> str:
        """How reality differed from the world model at the start, as text; empty if it did not."""
        exact = self.reality == exact_variation(self.scene)
        return "" if exact else self.reality.describe(self.scene.names)

    def recording(self, tool: str) -> Recording:
        """Return the recording of a tool while it was held; KeyError if the cell has no such tool."""
        return self.observers[tool].recorder.recording()

    def peak_force_n(self, tool: str) -> float:
        """Return the greatest force on a tool while it was held; KeyError if the cell has no such tool."""
        return self.observers[tool].peak_force.newton

    def mean_force_n(self, tool: str, since: float) -> float:
        """Return the mean force on a tool's working face from `since` in s on; KeyError if there is no such tool."""
        return self.observers[tool].recorder.mean_force_n(since)

    def surface_pose(self, surface: str) -> Pose:
        """Return the true pose of a surface in the world; KeyError if the cell has no such surface."""
        assumed = {each.individual: each.pose for each in self.scene.surfaces}
        return self.reality.of(surface).true_pose(assumed[surface])

    def is_present(self, surface: str) -> bool:
        """Whether a surface really is there; KeyError if the cell has no such surface."""
        return self.reality.of(surface).present

    def coverage(self, surface: str) -> CoverageMap:
        """Return where and how long tools have worked on a surface; KeyError if the cell has no such surface."""
        return self.covered[surface]

    def fixture_pose(self, fixture: str) -> Pose:
        """Return the true pose of a fixture in the world; KeyError if the cell has no such fixture."""
        pairs = zip(self.scene.fixtures, self.reality.fixtures, strict=True)
        poses = {assumed.individual: true.true_pose(assumed.pose) for assumed, true in pairs}
        return poses[fixture]

    def face_position(self, tool: str) -> Array:
        """Return where the middle (3,) of a tool's working face is, in m in the world; KeyError for an unknown tool."""
        return np.array(self.data.site(part_name(self.scene.names[tool], "face")).xpos)

    def body_pose(self, individual: str) -> Pose:
        """Return the true pose of a tool or a body in the world; KeyError if the cell has no such thing."""
        fixed = {each.individual for each in self.scene.bodies if not each.movable}
        known = {each.individual for each in self.scene.graspable} | fixed
        if individual not in known:
            raise KeyError(individual)
        name = self.scene.names[individual]
        found = self.data.body(name if individual in fixed else part_name(name, "block"))
        return Pose(found.xpos.copy(), found.xmat.reshape(3, 3).copy())

    def carried_by(self, gripper: str) -> str | None:
        """Return what is really in a gripper, None if nothing is; KeyError if the cell has no such gripper."""
        return self.grippers[gripper].carries

    def hand(self, gripper: str) -> HandSample:
        """Return where a gripper really is and how it grips; KeyError if the cell has no such gripper."""
        return self.grippers[gripper].sample()

    def contact_force(self, gripper: str) -> Array | None:
        """Return the force (3,) in N with which a hand and what it holds press on the rest; None if not computed."""
        return self.grippers[gripper].contact_force()

    def pressing(self, button: str) -> Array:
        """Return the steps (n, 3) with a force on a button: time in s, force in N, 1 if it had switched, else 0."""
        return self.buttons[button].pressing

    def contacts(self) -> tuple[Touching, ...]:
        """Return what links, hands, bases and the rigid parts of held objects have touched, in order of time."""
        return self.touches.touchings

    def guidances(self) -> tuple[Guidance, ...]:
        """Return how people guided tools by hand; people who guided none are left out."""
        return tuple(
            Guidance(each.place, guided[:, 1], guided[:, 0], each.arm)
            for each in self.people
            if len(guided := each.guided)
        )
