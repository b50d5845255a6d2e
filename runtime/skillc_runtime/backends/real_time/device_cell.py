"""A cell of devices that have their own time: it lets the wall clock run, and stops them when nobody is in charge."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from threading import Event, Thread
from time import monotonic

from skillc_runtime.backends.real_time.locked import DRIVER_PARTS, CellLock, locked
from skillc_runtime.control.supervision.watchdog import HEARTBEAT_TIMEOUT_S, HeartbeatWatchdog
from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.devices.backend import Backend, BackendBroken, DeviceStop, StopPersists
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.devices.camera import PoseCamera
from skillc_runtime.devices.capabilities import BackendCapabilities
from skillc_runtime.devices.cell import Cell, Watchdog
from skillc_runtime.devices.device_map import DeviceMap, NoSuchDevice
from skillc_runtime.devices.device_states import DeviceStates
from skillc_runtime.devices.device_stopper import DeviceStopper, StoppableArm
from skillc_runtime.devices.drawing import Drawing
from skillc_runtime.devices.gripper import Gripper
from skillc_runtime.devices.live import LiveSignals
from skillc_runtime.devices.observed import CellObserver
from skillc_runtime.devices.sensors import Button, Camera, IoPoint
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.model import WorldModel

LOOK_S = 0.02
"""How often the cell checks whether runs send heartbeats and whether devices have faults, in s."""

SHORTEST_S = 1e-4
"""The time that passes in each call of `advance`, at least, in s."""

CLOSE_S = 2.0
"""How long the end of the watching thread is waited for, in s."""


@dataclass(frozen=True, slots=True)
class CellDevices:
    """The devices of a cell, by IRI; each is called by one thread at a time.

    `tree_timeout_s` is how long a run may send no heartbeat before all devices are stopped.
    `live` is what is recorded of them in each period, by whoever calls its listeners; None for nothing.
    `drawing` is how their model looks, `observer` looks at them beside the scene; None without one. `find_fault`
    returns why a device cannot go on, for example because it does not answer, or a stop that it has reported; None
    while all can. `recover` acknowledges that; it raises StopPersists if somebody has to do more. `passed` is called
    whenever time has passed, in the thread of `advance`. `close` gives the devices back.
    """

    arms: Mapping[str, StoppableArm] = field(default_factory=dict)
    grippers: Mapping[str, Gripper] = field(default_factory=dict)
    bases: Mapping[str, MobileBase] = field(default_factory=dict)
    cameras: Mapping[str, PoseCamera] = field(default_factory=dict)
    buttons: Mapping[str, Button] = field(default_factory=dict)
    io_points: Mapping[str, IoPoint] = field(default_factory=dict)
    inspection: Camera | None = None
    live: LiveSignals | None = None
    drawing: Drawing | None = None
    observer: CellObserver | None = None
    find_fault: Callable[[], str | DeviceStop | None] = lambda: None
    recover: Callable[[], None] = lambda: None
    passed: Callable[[], None] = lambda: None
    close: Callable[[], None] = lambda: None
    tree_timeout_s: float = HEARTBEAT_TIMEOUT_S


class DeviceCell(Backend, Cell):
    """A cell of real devices, implementing `Cell` and `Backend`: nothing of it is simulated, so it offers no truth.

    `advance` waits. A thread of its own stops all devices if no heartbeat comes any more; if one of them cannot go on,
    all stop, until somebody has acknowledged that and it can. The world model has the state of each arm.
    """

    def __init__(self, world: WorldModel, devices: CellDevices) -> None:
        """Take the devices, which are at rest."""
        self._world, self._devices = world, devices
        state = world.snapshot()
        names = {each: state.vocabulary.short(each) for each in state.individuals}
        self._arms = DeviceMap("arm", devices.arms, names)
        self._grippers = DeviceMap("gripper", devices.grippers, names)
        self._bases = DeviceMap("mobile base", devices.bases, names)
        self._cameras = DeviceMap("camera", devices.cameras, names)
        self._buttons = DeviceMap("button", devices.buttons, names)
        self._io_points = DeviceMap("I/O point", devices.io_points, names)
        self._capabilities = BackendCapabilities(live=devices.live, drawing=devices.drawing, observer=devices.observer)
        self._stopper = DeviceStopper(devices.arms, devices.grippers, devices.bases, names)
        self._states = DeviceStates(world, devices.arms)
        self._states.begin()
        self._turn, self._closing = CellLock(), Event()
        self._began = self._due = monotonic()
        self._broken: str | None = None
        self._fault: DeviceStop | None = None
        self._is_raised = True
        self._heartbeats = HeartbeatWatchdog(devices.tree_timeout_s)
        self._watchdog: Watchdog = locked(self._heartbeats, self._turn)
        self._thread = Thread(target=self._watch, name="watch devices", daemon=True)
        self._thread.start()

    @property
    def capabilities(self) -> BackendCapabilities:
        """What it offers besides running its devices."""
        return self._capabilities

    @property
    def now(self) -> float:
        """The time in s since the cell started, of the wall clock."""
        return monotonic() - self._began

    @property
    def cell(self) -> DeviceCell:
        """The cell as skills see it."""
        return self

    @property
    def clock(self) -> DeviceCell:
        """The clock of the cell."""
        return self

    @property
    def world(self) -> WorldModel:
        """The world model."""
        return self._world

    @property
    def watchdog(self) -> Watchdog:
        """The watchdog, to which every run sends heartbeats."""
        return self._watchdog

    @property
    def broken(self) -> str | None:
        """Why the cell cannot go on; None while it can."""
        return self._broken

    @property
    def stops(self) -> DeviceCell:
        """Why devices have stopped by themselves."""
        return self

    @property
    def report(self) -> DeviceStop | None:
        """The fault that a device has reported and nobody has acknowledged, or that is still there; None for none."""
        return self._fault

    def clear(self) -> None:
        """Forget a fault, because somebody has acknowledged it; StopPersists, and nothing has changed."""
        with self._turn:
            self._devices.recover()
            if (fault := self._find_fault()) is not None:
                raise StopPersists(fault.reason)
            self._fault = None
        self._states.clear()

    def arm(self, individual: str) -> ArmDriver:
        """Return an arm's driver; KeyError if the cell has no such arm."""
        return locked(self._arms[individual], self._turn, DRIVER_PARTS)

    def find_standing_joints(self, individual: str) -> Array | None:
        """Return at which joints (nv,) in rad an arm stands; None while it moves."""
        with self._turn:
            motion = self._arms[individual].motion
            return motion.stopping_joints() if motion.stationary else None

    def gripper(self, individual: str) -> Gripper:
        """Return a gripper; KeyError if the cell has no such gripper."""
        return locked(self._grippers[individual], self._turn)

    def base(self, individual: str) -> MobileBase:
        """Return the mobile base of a robot; KeyError if it has none."""
        return locked(self._bases[individual], self._turn)

    def pose_camera(self, individual: str) -> PoseCamera:
        """Return a camera that estimates poses; KeyError if the cell has no such camera."""
        return locked(self._cameras[individual], self._turn)

    def camera(self) -> Camera:
        """Return the camera that inspects surfaces; KeyError if the cell has none."""
        if self._devices.inspection is None:
            raise NoSuchDevice("the cell has no camera that inspects surfaces")
        return locked(self._devices.inspection, self._turn)

    def button(self, individual: str) -> Button:
        """Return a button; KeyError if the cell has no such button."""
        return locked(self._buttons[individual], self._turn)

    def io_point(self, individual: str) -> IoPoint:
        """Return an input or output; KeyError if the cell has no such I/O point."""
        return locked(self._io_points[individual], self._turn)

    def is_at_rest(self, devices: Collection[str] | None = None) -> bool:
        """Whether devices, all if None, neither move nor push."""
        with self._turn:
            return self._broken is not None or self._stopper.at_rest(devices)

    def advance(self, seconds: float) -> None:
        """Wait until `seconds` have passed since the last call has returned; BackendBroken, once, for each fault.

        So ticks have the rate that is wanted, whatever the time is that they take; what is late is not caught up with.
        """
        self._due = max(self._due + seconds, monotonic() + SHORTEST_S)
        if self._closing.wait(self._due - monotonic()):
            raise BackendBroken(self._broken or "the cell is closed")
        with self._turn:
            fault, is_raised, self._is_raised = self._fault, self._is_raised, True
        self._devices.passed()
        self._states.note(fault)
        if fault is not None and not is_raised:
            raise BackendBroken(fault.reason)

    def publish(self) -> None:
        """Write to the world model which arms have stopped."""
        self._states.note(self._fault)

    def secure(self, devices: Collection[str] | None = None) -> Sequence[str]:
        """Stop devices, all if None, and pushes, and restore releases; return what was not in order."""
        with self._turn:
            return self._stopper.secure(devices)

    def close(self) -> None:
        """Stop all devices and give them back."""
        if self._broken is not None:
            return
        self._broken = "the cell is closed"
        self._closing.set()
        self._thread.join(CLOSE_S)
        with self._turn:
            self._abort(self._broken)
            self._devices.close()

    def _watch(self) -> None:
        """Stop all devices when their client is silent, or when one of them cannot go on."""
        while not self._closing.wait(LOOK_S):
            with self._turn:
                if self._heartbeats.expired(self.now):
                    self._abort("the tree is not ticked any more")
                if (fault := self._find_fault()) is not None:
                    self._take_fault(fault)

    def _take_fault(self, fault: DeviceStop) -> None:
        """Stop all devices for the first fault; what is said of it later, or an emergency stop, is reported instead."""
        if self._fault is None:
            self._fault, self._is_raised = fault, False
            self._abort(fault.reason)
        elif fault.kind == "emergency-stop" or fault.reason.startswith(self._fault.reason):
            self._fault = fault

    def _abort(self, reason: str) -> None:
        """Stop all devices; one that cannot be stopped is a fault."""
        try:
            self._stopper.abort(reason)
        except Exception as error:  # noqa: BLE001  the boundary to the devices
            fault = DeviceStop("protective-stop", f"{reason}; a device could not be stopped: {error!r}")
            self._fault, self._is_raised = fault, False

    def _find_fault(self) -> DeviceStop | None:
        """Return why a device cannot go on; a look that fails is a fault as well, since nobody else would notice."""
        try:
            fault = self._devices.find_fault()
        except Exception as error:  # noqa: BLE001  the boundary to the devices
            fault = f"the look at the devices has failed: {error!r}"
        return DeviceStop("protective-stop", fault) if isinstance(fault, str) else fault
