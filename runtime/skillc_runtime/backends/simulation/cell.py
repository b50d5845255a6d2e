"""What cells that are computed from a MuJoCo model have in common: devices, controllers, world model, ground truth."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Iterator, Sequence
from functools import partial
from typing import Any, Generic, TypeVar

import mujoco

from skillc_runtime.backends.simulation.arms.arm import ModelledArm
from skillc_runtime.backends.simulation.arms.driver_factory import make_driver
from skillc_runtime.backends.simulation.arms.stops import SimulatedStops
from skillc_runtime.backends.simulation.bases.base import SimulatedBase
from skillc_runtime.backends.simulation.button import SimulatedButton, make_buttons
from skillc_runtime.backends.simulation.cameras.camera import SimulatedCamera
from skillc_runtime.backends.simulation.cameras.pose_camera import SimulatedPoseCamera
from skillc_runtime.backends.simulation.cargo import Cargo
from skillc_runtime.backends.simulation.checkpoint import Checkpoint, encode_checkpoint
from skillc_runtime.backends.simulation.contacts import Contacts
from skillc_runtime.backends.simulation.hands.gripper import ModelledGripper
from skillc_runtime.backends.simulation.io_points import SimulatedPoint, make_points
from skillc_runtime.backends.simulation.live_signals import make_live_signals
from skillc_runtime.backends.simulation.model.drawing import ModelDrawing
from skillc_runtime.backends.simulation.model.model_builder import build_model
from skillc_runtime.backends.simulation.model.mujoco_warnings import log_warnings
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.parts import ArmPart, Listening
from skillc_runtime.backends.simulation.saved_cell import read_posture, restore_cell, save_cell
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.backends.simulation.steps import Due, ForItself, InPython, OnMemory, Steps, is_due
from skillc_runtime.backends.simulation.truth.claims import find_false_claims
from skillc_runtime.backends.simulation.truth.observer import ToolObserver
from skillc_runtime.backends.simulation.truth.touch_recorder import TouchRecorder
from skillc_runtime.backends.simulation.truth.truth import SimulatedTruth
from skillc_runtime.backends.simulation.twin import keep_reported
from skillc_runtime.backends.simulation.variation.disturber import SimulatedDisturber
from skillc_runtime.backends.simulation.variation.person import make_people
from skillc_runtime.backends.simulation.variation.variation import Variation
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.control.supervision.watchdog import HeartbeatWatchdog
from skillc_runtime.devices.backend import BackendBroken, DeviceStop
from skillc_runtime.devices.capabilities import BackendCapabilities
from skillc_runtime.devices.device_map import DeviceMap
from skillc_runtime.devices.device_states import DeviceStates
from skillc_runtime.devices.device_stopper import DeviceStopper
from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.devices.sensors import Camera
from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.numerics.compiled import bind
from skillc_runtime.motion.numerics.program import Part
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.world.space.frames import relocation_changes, size
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DEVICE_STATE

A = TypeVar("A", bound=ModelledArm)
G = TypeVar("G", bound=ModelledGripper)


class ModelledCell(ABC, Generic[A, G]):
    """A cell in lock step, implementing `Cell` and `Backend`; subclasses make arms and grippers, and move all of it.

    `variation` is how reality differs from the facts of `scene`. Between calls of `advance` all measurements are of the
    present instant. `steps` runs what takes part, in order; `steps_without_control` all but the controllers. The world
    model has the state of each arm: `Idle`, or `Fault` from a stop until it is acknowledged.
    """

    cargo_type: type[Cargo] = Cargo
    has_physics: bool = False

    def __init__(
        self, world: WorldModel, scene: SceneSpec, variation: Variation, timestep_s: float, steps_per_command: int,
        checkpoint: Checkpoint | None = None,
    ) -> None:  # fmt: skip
        """Build the cell, as it was at a checkpoint; controllers run every `steps_per_command` steps.

        Raises SheetError or FrameError if facts are missing or contradict the models.
        """
        log_warnings()
        self._world, self.scene, self.variation, self._restored = world, scene, variation, checkpoint
        self.model: Any = build_model(scene, variation, timestep_s)
        self.data: Any = mujoco.MjData(self.model)
        self.data.time = checkpoint.time_s if checkpoint is not None else 0.0
        self.contacts = Contacts(self.model, self.data)
        self._timestep, self._steps_per_command = timestep_s, steps_per_command
        self._broken: str | None = None
        self._reports: list[tuple[Sequence[Change], str, Evidence]] = []
        self.arms, self._hands = self._make_arms()
        names, hands = scene.names, {a.gripper.individual: self._hands[a.individual] for a in scene.arms if a.gripper}
        self._grippers = DeviceMap("gripper", hands, names)
        bases = {b.individual: SimulatedBase(b, names[b.individual], self.model, self.data) for b in scene.bases}
        self._bases = DeviceMap("mobile base", bases, names)
        self._cargo = {
            each: self.cargo_type(scene, each, self._hands, self.model, self.data, self.contacts)
            for each in self._bases
        }
        poses = {s.individual: variation.of(s.individual).true_pose(s.pose) for s in scene.surfaces}
        self.coverage = {
            s.individual: CoverageMap(poses[s.individual], s.layout, s.least_n, s.dirt) for s in scene.surfaces
        }
        if checkpoint is not None:
            restore_cell(checkpoint, self.model, self.data, self._bases, self._grippers, self.coverage)
        self._prepare()
        drivers = {a.individual: make_driver(a, self.arms[a.individual], self.period_s) for a in scene.arms}
        self._drivers = DeviceMap("arm", drivers, names)
        self._states = DeviceStates(world, drivers)
        self._stopper = DeviceStopper(self._drivers, self._grippers, self._bases, names)
        self._observers = {
            tool.individual: ToolObserver(tool, names, self.model, self.data, self.coverage) for tool in scene.tools
        }
        self._cameras = DeviceMap("camera", self._make_cameras(), names)
        self.watchdog = HeartbeatWatchdog()
        self._buttons = DeviceMap("button", make_buttons(scene.fixtures, variation.fixtures, names, self.data), names)
        self._io_points = DeviceMap("I/O point", make_points(world.snapshot()), names)
        self.people = make_people(scene, variation, self.arms, self._drivers, self.data)
        self._touches = TouchRecorder(scene, self.model, self.contacts, self._held_things)
        self.ground_truth: GroundTruth = SimulatedTruth(
            scene, variation, self._observers, self.coverage, self._buttons, self.people, self._touches, self._grippers,
            self.data,
        )  # fmt: skip
        self.stops = SimulatedStops(self._drivers, self._stopper, self._states, names)
        self.disturber = SimulatedDisturber(self, scene, self.model, self.data, self._hands, self.stops)
        self.drawing = ModelDrawing(scene, variation, self.model, self.data)
        self._camera = self._make_inspection_camera()
        self.live = make_live_signals(scene, self.period_s, self.arms, self._drivers, self.model, self.data)
        self.capabilities = BackendCapabilities(
            lock_step=self, judge=self, truth=self.ground_truth, drawing=self.drawing, disturber=self.disturber,
            checkpoints=self, live=self.live, imperfect=self.has_physics,
        )  # fmt: skip
        control, others = tuple(self._control_parts()), (*self._device_parts(), *self._parts())
        self.steps = Steps(control, others, steps_per_command, timestep_s)
        self.steps_without_control = Steps((), others, steps_per_command, timestep_s)
        world.weigh_evidence(self._weigh_evidence)
        self._report_idle()

    def _report_idle(self) -> None:
        """Report that arms are idle; one that goes on from a checkpoint has reported it unless it was busy then."""
        first, state = self._restored is None, self._world.snapshot()
        self._states.begin(arm for arm in sorted(self._drivers) if first or state.value(arm, DEVICE_STATE) != "Idle")

    @property
    def now(self) -> float:
        """The simulated time in s since the cell was first built."""
        return float(self.data.time)

    @property
    def cell(self) -> ModelledCell[A, G]:
        """The cell as skills see it."""
        return self

    @property
    def clock(self) -> ModelledCell[A, G]:
        """The clock of the cell."""
        return self

    @property
    def broken(self) -> str | None:
        """Why the cell cannot go on; None while it can."""
        return self._broken

    def is_at_rest(self, devices: Collection[str] | None = None) -> bool:
        """Whether devices, all if None, neither move nor push; nothing moves once the cell is broken."""
        return self._broken is not None or self._stopper.at_rest(devices)

    @property
    def period_s(self) -> float:
        """The control period in s."""
        return self._timestep * self._steps_per_command

    @property
    def world(self) -> WorldModel:
        """The world model."""
        return self._world

    def arm(self, individual: str) -> CompliantArmDriver:
        """Return an arm's driver; KeyError if the cell has no such arm."""
        return self._drivers[individual]

    def find_standing_joints(self, individual: str) -> Array | None:
        """Return at which joints (nv,) in rad an arm stands; None while it moves."""
        motion = self._drivers[individual].motion
        return motion.stopping_joints() if motion.stationary else None

    def gripper(self, individual: str) -> G:
        """Return a gripper; KeyError if the cell has no such gripper."""
        return self._grippers[individual]

    def base(self, individual: str) -> SimulatedBase:
        """Return the mobile base of a robot; KeyError if it has none."""
        return self._bases[individual]

    def pose_camera(self, individual: str) -> SimulatedPoseCamera:
        """Return a camera that estimates poses; KeyError if the cell has no such camera."""
        return self._cameras[individual]

    def camera(self) -> Camera:
        """Return the camera that inspects surfaces."""
        return self._camera

    def button(self, individual: str) -> SimulatedButton:
        """Return a button; KeyError if the cell has no such button."""
        return self._buttons[individual]

    def io_point(self, individual: str) -> SimulatedPoint:
        """Return an input or output; KeyError if the cell has no such I/O point."""
        return self._io_points[individual]

    def advance(self, seconds: float) -> None:
        """Advance controllers and devices, step by step.

        ControlError if a controller cannot continue, BackendBroken if the cell cannot; after that it never advances.
        """
        try:
            self._advance(self.steps, round(seconds / self._timestep))
        finally:
            self.publish()

    def advance_period(self) -> None:
        """Run one control period; errors as of `advance`, but the world model is not written: `publish` does."""
        self._advance(self.steps, self._steps_per_command)

    def hold_period(self) -> None:
        """Let a control period pass without commands: arms hold still by themselves, grippers and bases stop."""
        self._stopper.stop()
        self.steps_without_control.run(self.data.time, self._steps_per_command)

    def publish(self) -> None:
        """Write to the world model what devices have reported since the last call."""
        reports, self._reports = self._reports, []
        for changes, origin, evidence in reports:
            self._world.commit(changes, origin, evidence)
        if self._broken is not None:
            self._states.note(DeviceStop("protective-stop", self._broken, tuple(sorted(self._drivers))))
        self._states.note(self.stops.report)

    def save(self) -> bytes:
        """Return the true state of the cell as an encoded checkpoint, from which it can be built again."""
        cell = save_cell(self.scene, self.model, self.data, self._bases, self._grippers, self.coverage)
        return encode_checkpoint(cell)

    def save_reported(self) -> bytes:
        """Return only what devices report of themselves, from which a twin of the cell is built."""
        return keep_reported(self.save(), self.drawing.prefixes.values())

    def stop_all(self, reason: str) -> None:
        """Stop all devices; arms report the reason as a fault."""
        self._stopper.abort(reason)

    def secure(self, devices: Collection[str] | None = None) -> tuple[str, ...]:
        """Stop devices, all if None, and pushes, and restore releases; return what was not in order.

        For the end of a run, however it ended; the result is empty after a regular end.
        """
        return self._stopper.secure(devices)

    def push_hand(self, arm: str, force_n: Array) -> None:
        """Push the hand of an arm with a force (3,) in N in the world from now on; 0 ends it. KeyError without hand."""
        palm = part_name(self.scene.names[self._hands[arm].individual], "palm")
        self.data.body(palm).xfrc_applied[:3] = force_n

    @property
    def things_lie_still(self) -> bool:
        """Whether nothing that no hand holds falls, rolls, tips or slides, as without physics."""
        return True

    def find_false_claims(self) -> tuple[str, ...]:
        """Return what the world model claims of what is where, and who holds what, that is not so; a sentence each.

        Nothing is judged in a cell that is broken: its physics may have diverged.
        """
        if self._broken is not None:
            return ()
        return find_false_claims(self.scene.bodies, self._world.snapshot(), self.ground_truth)

    def close(self) -> None:
        """Do nothing: a cell in lock step has no threads."""

    def _weigh_evidence(self, changes: Sequence[Change], stated: Evidence) -> Evidence:
        """Return the evidence that counts for changes of the world model, of what their writer states."""
        return stated

    def _start(self, arm: ArmSpec) -> Array:
        """Return the posture (nv,) in rad in which an arm is built."""
        return read_posture(self._restored, self.scene.names[arm.individual], self.variation.start(arm))

    @abstractmethod
    def _make_arms(self) -> tuple[dict[str, A], dict[str, G]]:
        """Return the arms, and the grippers by arm."""

    @abstractmethod
    def _prepare(self) -> None:
        """Compute what follows from the positions in `data`; called once arms, grippers and bases are in place."""

    @abstractmethod
    def refresh(self) -> None:
        """Compute what follows from positions in `data` that were changed between two steps."""

    @abstractmethod
    def _parts(self) -> Iterator[Part]:
        """Yield what moves everything by one step, once devices and people have acted, and observes it."""

    def _advance(self, steps: Steps, count: int) -> None:
        if self._broken is not None:
            raise BackendBroken(self._broken)
        try:
            steps.run(self.data.time, count)
        except BackendBroken as error:
            self._broken = str(error)
            raise

    def _control_parts(self) -> Iterator[Part]:
        """Yield what runs once a control period: the watchdog, controllers, listeners."""
        yield OnMemory(bind(is_due, Due(self.watchdog.due)), self._watch)
        yield from map(self._control_part, self._drivers)
        yield InPython(self._tell, lambda: not self.live.listeners)
        yield Listening(lambda: self.live.parts)

    def _control_part(self, individual: str) -> Part:
        """Return what runs the control periods of an arm."""
        is_lost = partial(self._stopper.lost.__contains__, individual)
        return ArmPart(self.arms[individual], self._drivers[individual], is_lost)

    def _device_parts(self) -> Iterator[Part]:
        """Yield what acts in each step: grippers, motors, people."""
        for gripper in self._grippers.values():
            yield ForItself(partial(self._step_gripper, gripper), partial(_is_idle, gripper))
        for arm in self.arms.values():
            yield arm.motors
        yield Listening(lambda: self.people)
        yield ForItself(self.disturber.step, lambda: not self.disturber.acts)

    def _watch(self, events: int, now: float) -> bool:
        if self.watchdog.expired(now):
            self.stop_all("the tree is not ticked any more")
        return True

    def _tell(self, now: float) -> None:
        for listen in self.live.listeners:
            listen()

    def _step_gripper(self, gripper: G, now: float) -> None:
        gripper.step(self._timestep)

    def _make_inspection_camera(self) -> Camera:
        """Return the camera that inspects surfaces and parts; its errors follow from the seed."""
        return SimulatedCamera(self.coverage, self.scene.inspection, self.variation.seed)

    def _make_cameras(self) -> dict[str, SimulatedPoseCamera]:
        """Return the cameras that estimate poses, by IRI; their errors follow from the seed."""
        names, seed = self.scene.names, self.variation.seed
        return {
            each.individual: SimulatedPoseCamera(each, names, self.model, self.data, seed)
            for each in self.scene.cameras
        }

    def _report(self, changes: Sequence[Change], origin: str, evidence: Evidence = "reported") -> None:
        """Keep changes of the world model until they are published."""
        self._reports.append((changes, origin, evidence))

    def _held_things(self) -> list[tuple[str, str]]:
        """Return each gripper that holds something, with that."""
        return [(name, hand.holding) for name, hand in self._grippers.items() if hand.holding is not None]

    def _notice_loss(self, individual: str) -> bool:
        """Tell whether fingers measure that what they held is lost; if so, stop the arm, and report where it was."""
        gripper = self._hands[individual]
        if (why := gripper.loss_message()) is not None:
            state, thing, arm = self._world.snapshot(), gripper.counted, self._drivers[individual]
            left_at = arm.measured.pose @ working_face(size(state, thing)).inverse()
            gripper.detach()
            arm.abort(why)
            self._report(relocation_changes(state, thing, left_at), why, "assumed")
        return why is not None

    def _move_bases(self, now: float) -> None:
        """Move bases with their cargo by one step."""
        for robot, base in self._bases.items():
            self._cargo[robot].move(base.step(self._timestep))
            if base.touched is not None:
                self._touches.add(self.scene.names[robot], base.touched, self.now, None)
                base.touched = None


def _is_idle(gripper: ModelledGripper) -> bool:
    return not gripper.moving
