"""A robot cell in simulation: devices, controllers and physics in one lock-step loop."""

from __future__ import annotations

import logging
from collections.abc import Callable, Collection, Iterator
from functools import cached_property, partial
from typing import Any

import numpy as np

from skillc_runtime.backends.mujoco.arm import SimulatedArm
from skillc_runtime.backends.mujoco.cargo import InertialCargo
from skillc_runtime.backends.mujoco.dirt_friction import DirtFriction
from skillc_runtime.backends.mujoco.gripper import SimulatedGripper
from skillc_runtime.backends.mujoco.parts import Drive, HalfStep, SlipWatch
from skillc_runtime.backends.mujoco.physics import Physics
from skillc_runtime.backends.simulation.arms.brakes import Brakes
from skillc_runtime.backends.simulation.cameras.camera import SimulatedCamera
from skillc_runtime.backends.simulation.cell import ModelledCell
from skillc_runtime.backends.simulation.checkpoint import Checkpoint, read_checkpoint
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.parts import HeldTool
from skillc_runtime.backends.simulation.saved_cell import read_scene_again
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.steps import ForItself, OnMemory
from skillc_runtime.backends.simulation.truth.observer import Carrier
from skillc_runtime.backends.simulation.variation.variation import Variation, draw_variation
from skillc_runtime.devices.backend import BackendStart
from skillc_runtime.devices.sensors import Camera
from skillc_runtime.motion.numerics.program import Part
from skillc_runtime.platforms.gl import RenderingError
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DEVICE_STATE

STILL_M_S, STILL_RAD_S = 0.01, 0.1
"""What moves slower than this lies still, unless it begins to fall."""

STILL_M_S2 = 1.0
"""What gets faster than this begins to fall, or bounces."""


def lie_still(scene: SceneSpec, held: Collection[str | None], model: Any, data: Any) -> bool:
    """Whether all that lies free or slides is still, besides what is `held`, in the last step of `data`."""
    names = scene.names
    free = [part_name(names[each.individual], "free") for each in scene.graspable if each.individual not in held]
    sliding = [part_name(names[each.individual], "slide") for each in scene.bodies if each.slide is not None]
    return all(_is_still(model.joint(each), data) for each in (*free, *sliding))


def _is_still(joint: Any, data: Any) -> bool:
    """Whether the first three velocities of a joint, m/s, the others, rad/s, and accelerations, m/s^2, are small."""
    first = int(joint.dofadr[0])
    dofs = slice(first, first + len(joint.damping))
    velocity, acceleration = data.qvel[dofs], data.qacc[dofs]
    return bool(
        np.linalg.norm(velocity[:3]) < STILL_M_S
        and np.linalg.norm(velocity[3:]) < STILL_RAD_S
        and np.linalg.norm(acceleration[:3]) < STILL_M_S2
    )


_log = logging.getLogger("skillc")


def make_backend(world: WorldModel, start: BackendStart) -> SimulatedCell:
    """Return a cell with physics; it is `MakeBackend`."""
    return SimulatedCell(world, start.seed, checkpoint=read_checkpoint(start))


class SimulatedCell(ModelledCell[SimulatedArm, SimulatedGripper]):
    """A cell built from the facts of a world model, with physics.

    `advance` raises SimulationDiverged if the physics diverges.
    `variation` is how reality differs from the facts. The same facts and the same seed give the same run, bit for bit.
    """

    cargo_type = InertialCargo
    has_physics = True

    def __init__(
        self,
        world: WorldModel,
        seed: int = 0,
        timestep_s: float = 0.001,
        steps_per_command: int = 1,
        reality: Callable[[SceneSpec, int], Variation] = draw_variation,
        checkpoint: Checkpoint | None = None,
    ) -> None:
        """Build the cell; controllers run every `steps_per_command` steps, `reality` draws how it differs from facts.

        With a checkpoint of an earlier cell of the same seed, all is as it was there.

        Raises SheetError or FrameError if facts are missing or contradict the models.
        """
        scene = read_scene_again(world.snapshot(), checkpoint)
        super().__init__(world, scene, reality(scene, seed), timestep_s, steps_per_command, checkpoint)

    @cached_property
    def physics(self) -> Physics:
        """What steps the cell."""
        return Physics(self.scene, self.variation, self.model, self.data, self.contacts)

    def _make_arms(self) -> tuple[dict[str, SimulatedArm], dict[str, SimulatedGripper]]:
        names, things, arms, hands = self.scene.names, self.scene.graspable, {}, {}
        physics = self.physics
        for facts in self.scene.arms:
            gripper, steps = facts.gripper, self._steps_per_command
            variation = self.variation
            arm = SimulatedArm(facts, names, physics, self._start(facts), variation.seed, steps, variation.sizes(facts))
            arms[facts.individual] = arm
            if gripper is not None:
                hands[facts.individual] = SimulatedGripper(gripper, names, things, arm, physics, self.variation.seed)
        return arms, hands

    @property
    def things_lie_still(self) -> bool:
        """Whether nothing that no hand holds falls, rolls, tips or slides; nothing moves once the cell is broken."""
        held = [each.carries for each in self._hands.values()]
        return self._broken is not None or lie_still(self.scene, held, self.model, self.data)

    def _make_inspection_camera(self) -> Camera:
        """Return a camera whose images are rendered if the scene has one and GL is there, or else the usual one."""
        spec = self.scene.image_camera
        if spec is None:
            return super()._make_inspection_camera()
        # Few cells have one, and all that makes and reads images takes a while to import.
        from skillc_runtime.backends.simulation.cameras.image_camera import ImageCamera

        seed = self.variation.seed
        try:
            camera = ImageCamera(
                spec, self.drawing, self.coverage, self.scene.names, self._world, seed,
                lambda arm: self._drivers[arm].measured.q,
            )  # fmt: skip
        except (RenderingError, ModuleNotFoundError) as error:
            _log.warning("no image is rendered: what is not felt Inspect reads of the simulator (idealised): %s", error)
            self._report_camera(spec.individual, "Fault", str(error))
            return SimulatedCamera(self.coverage, self.scene.inspection, seed, str(error))
        self._report_camera(spec.individual, "Idle", "start of the cell")
        return camera

    def _report_camera(self, camera: str, device_state: str, why: str) -> None:
        """Report the state of the inspection camera, if the world model has another one."""
        before = self._world.snapshot().value(camera, DEVICE_STATE)
        if before != device_state and not (before is None and device_state == "Idle"):
            self._report([SetProperty(camera, DEVICE_STATE, device_state)], why)

    def _prepare(self) -> None:
        self.physics.prepare()

    def refresh(self) -> None:
        """Compute what follows from what was changed in `data` or `model` between two steps."""
        self.physics.renew()

    def _drive(self, now: float) -> None:
        """Move bases with their cargo, which goes on with its own speed in the step after a base has come to rest."""
        self._move_bases(now)
        self.physics.take_changes()

    def _parts(self) -> Iterator[Part]:
        brakes = [arm.brakes for arm in self.arms.values() if arm.brakes is not None]
        yield from (ForItself(each.step, partial(_are_released, each)) for each in brakes)
        yield from (arm.friction for arm in self.arms.values() if arm.friction is not None)
        yield from DirtFriction(self.scene, self.physics, self.coverage).parts()
        yield HalfStep(self.physics, "mj_step2")
        yield from (arm.wrist for arm in self.arms.values() if arm.wrist is not None)
        yield self._touches
        yield from self._buttons.values()
        for arm, gripper in self._hands.items():
            yield HeldTool(gripper, Carrier(self._drivers[arm], self.arms[arm].live_base), self._observers)
            yield SlipWatch(gripper)
        for arm, gripper in self._hands.items():
            yield OnMemory(gripper.may_be_lost, partial(self._look_for_loss, arm))
        yield Drive(self._bases, self._cargo, self.physics, self._drive)
        yield HalfStep(self.physics, "mj_step1")

    def _look_for_loss(self, arm: str, events: int, now: float) -> bool:
        return self._notice_loss(arm)


def _are_released(brakes: Brakes) -> bool:
    return brakes.is_off
