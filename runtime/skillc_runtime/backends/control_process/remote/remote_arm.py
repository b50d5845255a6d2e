"""The driver of an arm that another process controls; implements `ArmDriver`, and what a cell needs of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress

import numpy as np

from skillc_runtime.backends.control_process.remote.host import ControlProcess
from skillc_runtime.backends.control_process.remote.remote_compliance import RemoteCompliance
from skillc_runtime.backends.control_process.remote.remote_motion import RemoteMotion
from skillc_runtime.backends.control_process.things import Thing
from skillc_runtime.backends.simulation.arms.driver_factory import read_safety_limits, read_task_limits
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.control.gains import read_gains
from skillc_runtime.control.kinematics import Kinematics
from skillc_runtime.control.laws.virtual_arm import load_virtual_model
from skillc_runtime.control.measured import MeasuredArm
from skillc_runtime.devices.arm import ArmLimits, ArmLoad, ArmState
from skillc_runtime.devices.arm_driver import LinkTorque
from skillc_runtime.devices.backend import BackendBroken, BackendUnavailable, DeviceStop, StopPersists
from skillc_runtime.motion.pose import Array, Pose


class RemoteArmDriver:
    """One arm whose control process runs. Poses are in the world; `base` returns that of the arm's base.

    What takes long is computed here, with the models of the facts; the control process takes small calls.
    held: what the hand holds, by IRI, and its pose in the frame of the empty hand's tool centre point.
    """

    def __init__(
        self, facts: ArmSpec, process: ControlProcess, base: Callable[[], Pose], things: Mapping[str, Thing]
    ) -> None:
        """`things` are those that its hand can hold, by IRI."""
        limits: ArmLimits = process.connected.limits
        self.limits, self.process, self.base, self._things = limits, process, base, things
        self.task_limits = read_task_limits(facts, read_gains(facts.controller, facts.sheet.number).limits)
        self.measured = RemoteMeasured(process, base)
        safety, kinematics = read_safety_limits(facts), Kinematics(load_virtual_model(facts.model))
        self.motion = RemoteMotion(process, base, kinematics, limits, safety)
        self.compliance = RemoteCompliance(process, base)
        self._individual, self._speed = facts.individual, 1.0
        self._reason: str | None = None
        self._load: ArmLoad | None = None
        self.held: tuple[str, Pose] | None = None

    @property
    def speed(self) -> float:
        """The share, above 0 to 1, of their speeds that motions and approaches have."""
        return self._speed

    def set_speed(self, share: float) -> None:
        """Let motions, also the present one, and approaches have this share of their speeds."""
        if share != self._speed:
            self.process.call("driver", "set_speed", share)
            self._speed = share

    @property
    def joints(self) -> Array:
        """The measured joints (nv,) in rad."""
        return self.measured.q

    @property
    def at_rest(self) -> bool:
        """Whether reference and joints are at rest and no skill pushes; an arm that nobody controls is."""
        snapshot = self.process.read()
        if self.process.find_silence() is not None or snapshot.phase != "in-control":
            return True
        return snapshot.holds("at_rest")

    def take_fault(self) -> str | None:
        """Return why the arm stopped by itself, once; None if it did not."""
        reason, self._reason = self._reason, None
        if reason is None and self.process.read().holds("faulted"):
            reason = self.process.call("driver", "take_fault")
        return reason

    def abort(self, reason: str) -> None:
        """Stop motion, overlays and push; the reason is reported as a fault, whether or not the process answers."""
        try:
            self.process.call("driver", "abort", reason)
        except BackendBroken:
            self._reason = reason

    def secure(self) -> bool:
        """Come to rest, stop pushing and restore all releases; tell whether any were left."""
        with suppress(BackendBroken):
            return bool(self.process.call("driver", "secure"))
        return False

    def find_stop(self) -> DeviceStop | None:
        """Return why the arm may not move before somebody has acknowledged that; None if it may."""
        if (silence := self.process.find_silence()) is not None:
            return DeviceStop("protective-stop", silence, (self._individual,))
        if not self.process.read().holds("stopped"):
            return None
        stop: DeviceStop | None = self.process.call("device", "explain")
        if stop is None:
            return None
        name = self.process.name
        reason = stop.reason if name in stop.reason else f"{name}: {stop.reason}"
        return DeviceStop(stop.kind, reason, (self._individual,))

    def recover(self) -> None:
        """Acknowledge a stop and take control again; StopPersists, with what somebody has to do."""
        try:
            if self.process.needs_restart:
                self._start_again()
            self.process.call_device("recover")
        except (BackendBroken, BackendUnavailable) as error:
            raise StopPersists(str(error)) from error

    def take_control(self) -> None:
        """Take control of the arm, which then holds still; ControlRefused."""
        self.process.call_device("take_control")

    def give_back(self) -> None:
        """Give control back; somebody else may move the arm."""
        self.process.call_device("give_back")

    def hold(self, thing: str, in_tool_centre: Pose, mass_kg: float, opening_m: float) -> None:
        """Count a thing as held, at a pose in the frame of the empty hand's tool centre point; grippers call this.

        opening_m: how far the fingers are open: where they are shifts the weight of the hand. RuntimeError if the scene
        had no such thing with a size when the cell was opened.
        """
        if thing not in self._things:
            raise RuntimeError(
                f"{thing.rpartition('#')[2]} cannot be held: it had no body when the cell was opened. A thing to "
                "handle needs a pose and skiros:SizeX, SizeY and SizeZ in the scene"
            )
        self.process.call_device("set_load", self._things[thing].load(in_tool_centre, mass_kg), opening_m)
        self.held = thing, in_tool_centre

    def set_load(self, load: ArmLoad | None) -> None:
        """Count this as held from now on, for the arm's model and for the device; None for the empty hand."""
        self.process.call_device("set_load", load)
        self._load, self.held = load, None

    def tare(self) -> None:
        """Let the wrench that is measured now be 0, while nothing touches the tool; NotOffered."""
        self.process.call_device("tare")

    def close(self) -> None:
        """Stop the arm, give it back, and end the process."""
        self.process.close()

    def _start_again(self) -> None:
        """Put another process in the place of the one that has ended, and tell it what this one knew."""
        self.process.restart()
        self.process.call_device("set_load", self._load)
        self.process.call("driver", "set_speed", self._speed)


class RemoteMeasured:
    """Implements `ArmMeasurements`; `base` returns the pose of the arm's base in the world."""

    def __init__(self, process: ControlProcess, base: Callable[[], Pose]) -> None:
        self._process, self._base = process, base

    @property
    def state(self) -> ArmState:
        """The last measurement, in the axes of the arm's base."""
        return self._process.read().state

    @property
    def pose(self) -> Pose:
        """The tool centre point in the world."""
        return self._now().pose

    @property
    def velocity(self) -> Array:
        """The twist (6,) of the tool, [linear m/s; angular rad/s], world axes."""
        return self._now().velocity

    @property
    def wrench(self) -> Array:
        """What is `felt`; where nothing measures it, the wrench (6,) of the environment that the law is to exert."""
        return self._now().wrench

    @property
    def pressing_n(self) -> float:
        """The force in N with which the tool presses along its axis, by `wrench`."""
        return self._now().pressing_n

    @property
    def felt(self) -> Array | None:
        """The wrench (6,) by a sensor or by the torques of the joints, N and N m, world axes; None without either."""
        return self._now().felt

    @property
    def q(self) -> Array:
        """The joints (nv,) in rad."""
        return self._process.read().field("q").copy()

    @property
    def still(self) -> bool:
        """Whether all joints are at rest."""
        return self._now().still

    def at_joints(self, q: Array) -> bool:
        """Tell whether the joints are at q (nv,) in rad."""
        return self._now().at_joints(q)

    def in_world(self, point: Array) -> Array:
        """Return a point (3,) in m of the arm's base frame in the world frame."""
        return self._base().apply(point)

    @property
    def link_torque(self) -> LinkTorque | None:
        """None: a control process does not tell whose torques it measures."""
        return None

    def _now(self) -> MeasuredArm:
        snapshot = self._process.read()
        felt, contact = snapshot.felt, snapshot.field("contact")
        found = MeasuredArm(self._base, lambda: np.asarray(contact), snapshot.state)
        found.felt_wrench = lambda: felt
        return found
