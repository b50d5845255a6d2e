"""Opens a cell of real arms: a control process for each, and the other devices of its back end."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack, suppress
from dataclasses import replace
from importlib import import_module
from pkgutil import iter_modules
from time import monotonic
from typing import TypeAlias

from skillc_runtime import primitives
from skillc_runtime.backends.control_process.ghost import Ghost
from skillc_runtime.backends.control_process.handshake import ControlTask, Patience
from skillc_runtime.backends.control_process.link import ControlRefused, LinkDescription
from skillc_runtime.backends.control_process.observing import DeviceObserver
from skillc_runtime.backends.control_process.periods.facts import read_patience
from skillc_runtime.backends.control_process.remote.cycle_feed import CycleFeed, FedArm
from skillc_runtime.backends.control_process.remote.host import ControlProcess
from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.control_process.things import find_things
from skillc_runtime.backends.real_time.device_cell import CellDevices, DeviceCell
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.devices.backend import BackendUnavailable, DeviceStop
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.motion.numerics.compiled import compile_imported
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.state.model import WorldModel

DescribeLink: TypeAlias = Callable[[ArmSpec], LinkDescription]
"""Returns the device of an arm from its facts; SheetError if one is missing."""

MakeDevices: TypeAlias = Callable[[SceneSpec, Mapping[str, RemoteArmDriver]], CellDevices]
"""Returns the devices of a cell besides its arms, which it gets by IRI: a gripper reports to its arm what
it holds (`RemoteArmDriver.hold`). `find_fault`, `recover` and `close` are those of these devices alone."""


def open_cell(
    world: WorldModel,
    describe: DescribeLink,
    make_devices: MakeDevices = lambda _scene, _arms: CellDevices(),
    patience: Patience | None = None,
    observed: bool = False,
) -> DeviceCell:
    """Return the cell of a world model, its arms under control and at rest.

    One that is only `observed` takes no control, offers none of its devices, and changes nothing in the world model.
    An arm that gives no control is reported as a stop of the cell. `patience` defaults to the facts of each arm.
    BackendUnavailable if a device does not answer or a camera is not driven; SheetError or FrameError if facts are
    missing or contradict each other or the device.
    """
    scene = read_scene_spec(world.snapshot())
    if not scene.arms:
        raise BackendUnavailable("the scene has no arm")
    things, patiences = find_things(scene), {each.individual: patience or read_patience(each) for each in scene.arms}
    load_all()
    with ExitStack() as opened:
        arms: dict[str, RemoteArmDriver] = {}
        bases: dict[str, MobileBase] = {}
        for facts in scene.arms:
            process = ControlProcess(ControlTask(facts, scene.names, describe(facts), patiences[facts.individual]))
            opened.callback(process.close)
            arms[facts.individual] = RemoteArmDriver(facts, process, _find_base(scene, facts, bases), things)
        others = make_devices(scene, arms)
        opened.callback(others.close)
        _check_cameras(scene, others)
        bases.update(others.bases)
        if observed:
            cell = _make_observed(world, scene, arms, others)
            opened.pop_all()
            return cell
        for arm in arms.values():
            with suppress(ControlRefused):
                arm.take_control()
        tree_timeout_s = min(each.tree_s for each in patiences.values())
        cell = _make_cell(world, scene, arms, replace(others, tree_timeout_s=tree_timeout_s))
        opened.pop_all()
    return cell


def _check_cameras(scene: SceneSpec, others: CellDevices) -> None:
    """Raise BackendUnavailable if a skill would find out in the middle of a task that nothing drives a camera."""
    for each in scene.cameras:
        if each.individual not in others.cameras:
            name = scene.names[each.individual]
            raise BackendUnavailable(f"nothing drives {name}: this back end has no cameras; take it out of the scene")


def load_all() -> None:
    """Import what skills call, and compile it: a tree that does so in its ticks is silent for too long."""
    for module in iter_modules(primitives.__path__, f"{primitives.__name__}."):
        import_module(module.name)
    compile_imported()


def _make_observed(
    world: WorldModel, scene: SceneSpec, arms: Mapping[str, RemoteArmDriver], others: CellDevices
) -> DeviceCell:
    """Return a cell that can be observed; it offers no device, so none can be commanded or stopped."""
    ghost = Ghost(scene, arms, others.grippers, others.bases, world.snapshot)
    observer = DeviceObserver(scene, arms, others)
    return DeviceCell(world, CellDevices(drawing=ghost, observer=observer, close=lambda: _close(arms.values(), others)))


def _make_cell(
    world: WorldModel, scene: SceneSpec, arms: Mapping[str, RemoteArmDriver], others: CellDevices
) -> DeviceCell:
    ghost = Ghost(scene, arms, others.grippers, others.bases, world.snapshot)
    fed = {
        each.individual: FedArm(arms[each.individual].process, arms[each.individual].base, each.force_torque)
        for each in scene.arms
    }
    feed = CycleFeed(fed, ghost.bodies)
    all_devices = _AllDevices(tuple(arms.values()), others, feed)
    cell = DeviceCell(
        world,
        replace(
            others,
            arms=arms,
            live=feed.live,
            drawing=ghost,
            observer=DeviceObserver(scene, arms, others),
            find_fault=all_devices.find_fault,
            recover=all_devices.recover,
            passed=all_devices.passed,
            close=all_devices.close,
        ),
    )
    feed.begin(monotonic() - cell.now)
    return cell


class _AllDevices:
    """The arms of a cell and its other devices, as a cell watches and ends them."""

    def __init__(self, arms: Sequence[RemoteArmDriver], others: CellDevices, feed: CycleFeed) -> None:
        self._arms, self._others, self._feed = arms, others, feed

    def find_fault(self) -> DeviceStop | str | None:
        """Return the worst stop of an arm, or what the other devices report."""
        stops = [stop for arm in self._arms if (stop := arm.find_stop()) is not None]
        emergency = (stop for stop in stops if stop.kind == "emergency-stop")
        return next(emergency, next(iter(stops), None)) or self._others.find_fault()

    def recover(self) -> None:
        """Acknowledge the stops of all devices; StopPersists."""
        self._others.recover()
        for arm in self._arms:
            if arm.find_stop() is not None:
                arm.recover()

    def passed(self) -> None:
        """Hand over what was recorded."""
        self._feed.hand_over()
        self._others.passed()

    def close(self) -> None:
        """Give all devices back."""
        _close(self._arms, self._others)


def _close(arms: Iterable[RemoteArmDriver], others: CellDevices) -> None:
    for arm in arms:
        arm.close()
    others.close()


def _find_base(scene: SceneSpec, facts: ArmSpec, bases: Mapping[str, MobileBase]) -> Callable[[], Pose]:
    """Return how to find an arm's base in the world; it moves with the mobile base that carries it, if there is one."""
    carrier = next((each for each in scene.bases if each.individual == facts.robot), None)
    if carrier is None:
        return lambda: facts.base
    mounted = carrier.pose.inverse() @ facts.base

    def find() -> Pose:
        base = bases.get(carrier.individual)
        return facts.base if base is None else base.pose @ mounted

    return find
