"""A robot cell in simulation: devices, controllers and physics in one lock-step loop."""

from __future__ import annotations

import sys
from collections.abc import Callable, Collection
from typing import Any

import mujoco

from skillc_runtime.backends.mujoco.arm import SimulatedArm
from skillc_runtime.backends.mujoco.base import SimulatedBase
from skillc_runtime.backends.mujoco.button import SimulatedButton, make_buttons
from skillc_runtime.backends.mujoco.coverage import CoverageMap, SimulatedCamera
from skillc_runtime.backends.mujoco.driver_factory import make_driver
from skillc_runtime.backends.mujoco.gripper import SimulatedGripper
from skillc_runtime.backends.mujoco.model_builder import build_model
from skillc_runtime.backends.mujoco.observer import SimulatedTruth, ToolObserver
from skillc_runtime.backends.mujoco.person import make_people
from skillc_runtime.backends.mujoco.scene_spec import SceneSpec, read_scene_spec
from skillc_runtime.backends.mujoco.variation import Variation, draw_variation
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.control.watchdog import HeartbeatWatchdog
from skillc_runtime.devices.gripper import working_face
from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.frames import placement_changes, size
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DEVICE_STATE


class SimulatedCell:
    """A cell built from the facts of a world model, implementing `Cell` and `Backend`.

    `variation` is how reality differs from the facts. The same facts and the same seed give the same run, bit for bit.
    Between calls of `advance` all measurements are of the present instant. The world model has the state of each arm:
    `Idle` at the start, `Fault` once it is broken.
    """

    def __init__(
        self,
        world: WorldModel,
        seed: int = 0,
        timestep_s: float = 0.001,
        steps_per_command: int = 1,
        reality: Callable[[SceneSpec, int], Variation] = draw_variation,
    ) -> None:
        """Build the cell; controllers run every `steps_per_command` steps, `reality` draws how it differs from facts.

        Raises SheetError or FrameError if facts are missing or contradict the models.
        """
        print_warnings()
        self._world = world
        self.scene: SceneSpec = read_scene_spec(world.snapshot())
        self.variation: Variation = reality(self.scene, seed)
        self.model: Any = build_model(self.scene, self.variation, timestep_s)
        self.data: Any = mujoco.MjData(self.model)
        self._timestep, self._steps_per_command, self._step = timestep_s, steps_per_command, 0
        self.arms, self._hands = self._make_arms()
        self._grippers = {a.gripper.individual: self._hands[a.individual] for a in self.scene.arms if a.gripper}
        names, facts = self.scene.names, self.scene
        self._bases = {b.individual: SimulatedBase(b, names[b.individual], self.model, self.data) for b in facts.bases}
        mujoco.mj_forward(self.model, self.data)
        self._drivers = {a.individual: make_driver(a, self.arms[a.individual], self.period_s) for a in facts.arms}
        poses = {s.individual: self.variation.of(s.individual).true_pose(s.pose) for s in facts.surfaces}
        self.coverage = {s.individual: CoverageMap(poses[s.individual], s.layout, s.least_n) for s in facts.surfaces}
        self._observers = {
            tool.individual: ToolObserver(tool, names, self.model, self.data, self.coverage) for tool in facts.tools
        }
        self.ground_truth: GroundTruth = SimulatedTruth(self._observers, poses)
        self._camera = SimulatedCamera(self.coverage)
        self.watchdog = HeartbeatWatchdog()
        self._buttons = make_buttons(facts.fixtures, self.variation.fixtures, names, self.data)
        self.people = make_people(facts, self.variation, self._drivers, self.data)
        idle = [SetProperty(arm, DEVICE_STATE, "Idle") for arm in sorted(self._drivers)]
        world.commit(idle, "start of the cell", "reported")

    @property
    def now(self) -> float:
        """The simulated time in s since the cell started."""
        return float(self.data.time)

    @property
    def cell(self) -> SimulatedCell:
        """The cell as skills see it."""
        return self

    @property
    def clock(self) -> SimulatedCell:
        """The clock of the cell."""
        return self

    @property
    def broken(self) -> str | None:
        """Why the cell cannot go on; None while it can."""
        return None

    def is_at_rest(self, devices: Collection[str] | None = None) -> bool:
        """Whether devices, all if None, neither move nor push."""
        moving: dict[str, CompliantArmDriver | SimulatedBase] = {**self._drivers, **self._bases}
        return all(each.at_rest for name, each in moving.items() if devices is None or name in devices)

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

    def gripper(self, individual: str) -> SimulatedGripper:
        """Return a gripper; KeyError if the cell has no such gripper."""
        return self._grippers[individual]

    def base(self, individual: str) -> SimulatedBase:
        """Return the mobile base of a robot; KeyError if it has none."""
        return self._bases[individual]

    def camera(self) -> SimulatedCamera:
        """Return the camera that inspects surfaces."""
        return self._camera

    def button(self, individual: str) -> SimulatedButton:
        """Return a button; KeyError if the cell has no such button."""
        return self._buttons[individual]

    def advance(self, seconds: float) -> None:
        """Advance controllers, devices and physics, step by step. ControlError if a controller cannot continue."""
        for _ in range(round(seconds / self._timestep)):
            self._advance_one()

    def secure(self, devices: Collection[str] | None = None) -> tuple[str, ...]:
        """Stop devices, all if None, and pushes, and restore releases; return what was not in order.

        For the end of a run, however it ended; the result is empty after a regular end.
        """
        names, found = self.scene.names, []
        for individual, arm in self._drivers.items():
            if devices is not None and individual not in devices:
                continue
            if (fault := arm.take_fault()) is not None:
                found.append(f"{names[individual]} had stopped: {fault}")
            if arm.secure():
                found.append(f"{names[individual]} was left yielding; it is held stiff again")
        self._stop_devices(devices)
        return tuple(found)

    def close(self) -> None:
        """Do nothing: the simulation has no threads."""

    def _stop_all(self, reason: str) -> None:
        for arm in self._drivers.values():
            arm.abort(reason)
        self._stop_devices()

    def _stop_devices(self, devices: Collection[str] | None = None) -> None:
        """Stop grippers and bases, all if None."""
        for name, gripper in self._grippers.items():
            if gripper.moving and (devices is None or name in devices):
                gripper.stop()
        for name, base in self._bases.items():
            if not base.at_rest and (devices is None or name in devices):
                base.stop()

    def _advance_one(self) -> None:
        now = self.data.time
        if self._step % self._steps_per_command == 0:
            if self.watchdog.expired(now):
                self._stop_all("the tree is not ticked any more")
            for individual, one in self._drivers.items():
                self._control(individual, one, now)
        for gripper in self._grippers.values():
            gripper.step(self._timestep)
        for arm in self.arms.values():
            arm.before_step()
        for person in self.people:
            person.step(now)
        mujoco.mj_step2(self.model, self.data)
        for arm in self.arms.values():
            arm.after_step()
        self._observe(now)
        for robot, base in self._bases.items():
            motion = base.step(self._timestep)
            if motion is not None:
                self._carry_along(robot, motion)
        mujoco.mj_step1(self.model, self.data)
        self._step += 1

    def _control(self, individual: str, arm: CompliantArmDriver, now: float) -> None:
        """Run a control period of one arm; write to the world model, once, that it is broken."""
        worked = arm.broken is None
        try:
            arm.step(now)
        finally:
            if worked and arm.broken is not None:
                self._world.commit([SetProperty(individual, DEVICE_STATE, "Fault")], arm.broken, "reported")

    def _observe(self, now: float) -> None:
        for button in self._buttons.values():
            button.sample(now)
        for arm, gripper in self._hands.items():
            if gripper.holding is not None:
                self._observers[gripper.holding].sample(now, self._drivers[arm])
                why = gripper.slip_message(now)
                if why is not None:
                    self._lose(arm, gripper, gripper.holding, why)

    def _lose(self, arm: str, gripper: SimulatedGripper, thing: str, why: str) -> None:
        """Stop an arm whose gripper has lost an object, and write the object's pose to the world model."""
        state, there = self._world.snapshot(), self._drivers[arm].measured.pose
        left_at = there @ working_face(size(state, thing)).inverse()
        gripper.lose()
        self._drivers[arm].abort(why)
        self._world.commit(placement_changes(thing, left_at), why, "assumed")

    def _carry_along(self, robot: str, motion: Pose) -> None:
        """Move objects held by the arms of a driving robot along with it."""
        for arm in self.scene.arms:
            if arm.robot == robot and arm.individual in self._hands:
                self._hands[arm.individual].move_with_base(motion)

    def _make_arms(self) -> tuple[dict[str, SimulatedArm], dict[str, SimulatedGripper]]:
        """Return the arms, and the grippers by arm."""
        names, arms, hands = self.scene.names, {}, {}
        for facts in self.scene.arms:
            gripper = facts.gripper
            palm = None if gripper is None else names[gripper.individual]
            name, steps = names[facts.individual], self._steps_per_command
            arm = SimulatedArm(facts, name, palm, self.model, self.data, self.variation, steps)
            arms[facts.individual] = arm
            if gripper is not None:
                hands[facts.individual] = SimulatedGripper(gripper, names, self.scene.tools, arm, self.model, self.data)
        return arms, hands


def print_warnings() -> None:
    """Print warnings of MuJoCo to stderr in this process; by default it writes MUJOCO_LOG.TXT."""
    mujoco.set_mju_user_warning(_print_warning)


def _print_warning(warning: str) -> None:
    print(f"simulation: {warning}", file=sys.stderr)
