"""A robot cell without physics, in lock step: devices, controllers and ideal contact."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import mujoco

from skillc_runtime.backends.kinematic.arm import KinematicArm
from skillc_runtime.backends.kinematic.gripper import KinematicGripper
from skillc_runtime.backends.kinematic.riders import Riders
from skillc_runtime.backends.kinematic.touch import Touch
from skillc_runtime.backends.simulation.cameras.camera import EXACT_INSPECTION, SimulatedCamera
from skillc_runtime.backends.simulation.cameras.pose_camera import SimulatedPoseCamera
from skillc_runtime.backends.simulation.cell import ModelledCell
from skillc_runtime.backends.simulation.checkpoint import Checkpoint, read_checkpoint
from skillc_runtime.backends.simulation.model.contact_bits import SOLID
from skillc_runtime.backends.simulation.parts import HeldTool
from skillc_runtime.backends.simulation.saved_cell import read_scene_again
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.steps import InPython
from skillc_runtime.backends.simulation.truth.observer import Carrier
from skillc_runtime.backends.simulation.variation.variation import Variation, exact_variation
from skillc_runtime.devices.backend import BackendStart
from skillc_runtime.motion.numerics.program import Part
from skillc_runtime.world.state.changes import AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import AT, DEVICE_STATE


def make_backend(world: WorldModel, start: BackendStart) -> KinematicCell:
    """Return a cell without physics; it is `MakeBackend`."""
    return KinematicCell(world, checkpoint=read_checkpoint(start))


class KinematicCell(ModelledCell[KinematicArm, KinematicGripper]):
    """A cell built from the facts of a world model, with the real drivers and control laws, and without physics.

    Joints follow their commands, nothing has weight, a grasp holds, and contact is a spring without friction. Reality
    is as the facts say, and there is no noise, unless `reality` says otherwise.
    """

    def __init__(
        self,
        world: WorldModel,
        timestep_s: float = 0.002,
        steps_per_command: int = 1,
        reality: Callable[[SceneSpec], Variation] = exact_variation,
        checkpoint: Checkpoint | None = None,
    ) -> None:
        """Build the cell; controllers run every `steps_per_command` steps.

        With a checkpoint of an earlier cell, all is as it was there.
        Raises SheetError or FrameError if facts are missing or contradict the models.
        """
        scene = read_scene_again(world.snapshot(), checkpoint)
        super().__init__(world, scene, reality(scene), timestep_s, steps_per_command, checkpoint)

    def _weigh_evidence(self, changes: Sequence[Change], stated: Evidence) -> Evidence:
        """Let only what does not depend on contact count as sensed or reported: where bases are, and device states."""
        free = all(self._is_free_of_contact(change) for change in changes)
        return stated if free or stated == "assumed" else "idealised"

    def _is_free_of_contact(self, change: Change) -> bool:
        match change:
            case AddRelation(subject, relation, _) | RemoveRelation(subject, relation, _):
                return relation == AT and subject in self._bases
            case SetProperty(_, property_, _):
                return property_ == DEVICE_STATE
            case _:
                return False

    def _make_arms(self) -> tuple[dict[str, KinematicArm], dict[str, KinematicGripper]]:
        self.model.opt.gravity[:] = 0.0
        self._let_links_pass()
        names, things, arms, hands = self.scene.names, self.scene.graspable, {}, {}
        for facts in self.scene.arms:
            start = self._start(facts)
            arm = KinematicArm(facts, names, self.model, self.data, start, self._steps_per_command)
            arms[facts.individual] = arm
            if facts.gripper is not None:
                hands[facts.individual] = KinematicGripper(
                    facts.gripper, names, things, arm, self.model, self.data, self.contacts
                )
        return arms, hands

    def _let_links_pass(self) -> None:
        """Let links and hands touch nothing: only contact of tools, bodies and pads is modelled."""
        (kind, met), model = SOLID, self.model
        links = (model.geom_contype & kind) > 0
        model.geom_contype[links] &= ~kind
        model.geom_conaffinity[links] &= ~met

    def _make_inspection_camera(self) -> SimulatedCamera:
        return SimulatedCamera(self.coverage, EXACT_INSPECTION, 0, "only the back end mujoco renders them")

    def _make_cameras(self) -> dict[str, SimulatedPoseCamera]:
        names = self.scene.names
        return {c.individual: SimulatedPoseCamera(c, names, self.model, self.data, None) for c in self.scene.cameras}

    def _prepare(self) -> None:
        self._riders = {arm: Riders(self.scene, self.model, self.data) for arm in self._hands}
        self._touch = Touch(self.scene, list(self.arms.values()), self.model, self.data)
        self._compute_state()

    def _parts(self) -> Iterator[Part]:
        yield from self._buttons.values()
        for arm, gripper in self._hands.items():
            yield HeldTool(gripper, Carrier(self._drivers[arm], self.arms[arm].live_base), self._observers)
        yield InPython(self._move)

    def _move(self, now: float) -> None:
        for individual in self._hands:
            self._notice_loss(individual)
        for arm in self.arms.values():
            arm.step(self._timestep)
        self._move_bases(now)
        self.data.time += self._timestep
        self._compute_state()

    def refresh(self) -> None:
        """Compute what follows from positions in `data` that were changed between two steps."""
        self._compute_state()

    def _compute_state(self) -> None:
        """Compute poses, what arms hold, contacts and sensors from the joints."""
        model, data = self.model, self.data
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        if self._place_held():
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            mujoco.mj_comVel(model, data)
        mujoco.mj_collision(model, data)
        self._touch.update(self._timestep)
        mujoco.mj_sensorPos(model, data)
        mujoco.mj_sensorVel(model, data)

    def _place_held(self) -> bool:
        """Place what arms hold in their hands, with what stands on it; tell whether they hold anything."""
        found = False
        for number, (individual, arm) in enumerate(self.arms.items()):
            gripper = self._hands.get(individual)
            if gripper is None:
                continue
            if gripper.carries is not None:
                twist, centre = arm.motion
                gripper.move_held(centre, twist)
                found = True
            riders = self._riders[individual].follow(gripper.carries)
            self._touch.hold(number, gripper.carries, riders)
        return found
