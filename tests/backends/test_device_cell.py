"""A cell of devices: it reports stops, acknowledges them, and stops all that can be stopped."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from simulation.cells import ARM, LAB, SURFACE, world
from skillc_runtime.backends.real_time.device_cell import CellDevices, DeviceCell
from skillc_runtime.devices.backend import BackendBroken, DeviceStop, StopPersists, find_first_stop
from skillc_runtime.devices.sensors import Camera
from skillc_runtime.primitives.inspect import Inspect
from skillc_runtime.world.state.facts import PropertyFact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DEVICE_STATE, IS_CLEAN
from waiting import wait_until


class Device:
    """Something that moves until it is stopped; `fails` if that cannot be done."""

    def __init__(self, fails: bool = False) -> None:
        self.moving, self.at_rest, self._fails = True, False, fails
        self.reasons: list[str] = []

    def stop(self) -> None:
        if self._fails:
            raise OSError("no route to the device")
        self.moving, self.at_rest = False, True

    def abort(self, reason: str) -> None:
        self.reasons.append(reason)
        self.stop()


class Reports:
    """What devices report, and whether somebody can acknowledge it."""

    def __init__(self) -> None:
        self.fault: DeviceStop | str | None = None
        self.persists: str | None = None

    def recover(self) -> None:
        if self.persists is not None:
            raise StopPersists(self.persists)
        self.fault = None


Make = Callable[..., DeviceCell]


@pytest.fixture
def make() -> Iterator[Make]:
    made: list[DeviceCell] = []

    def build(reports: Reports, **devices: Any) -> DeviceCell:
        found = CellDevices(find_fault=lambda: reports.fault, recover=reports.recover, **devices)
        made.append(DeviceCell(WorldModel(world("iiwa_table")), found))
        return made[-1]

    yield build
    for each in made:
        each.close()


def test_an_emergency_stop_is_reported_as_such_and_told_once(make: Make) -> None:
    reports, arm = Reports(), Device()
    cell = make(reports, arms={ARM["iiwa_table"]: arm})
    reports.fault = DeviceStop("emergency-stop", "the button at the door is pressed")
    wait_until(lambda: arm.reasons == ["the button at the door is pressed"])
    assert cell.stops.report == reports.fault
    with pytest.raises(BackendBroken, match="the button at the door"):
        cell.advance(0.001)
    cell.advance(0.001)


@pytest.mark.parametrize("device", [ARM["iiwa_table"], LAB + "Robotiq-1"])
def test_a_device_is_faulty_in_the_world_model_from_its_stop_until_that_is_acknowledged(
    make: Make, device: str
) -> None:
    reports = Reports()
    cell = make(reports, arms={ARM["iiwa_table"]: Device()})
    states = [cell.world.snapshot().value(device, DEVICE_STATE)]
    reports.fault = find_first_stop([("other", None), (device, "it does not answer")])
    wait_until(lambda: cell.stops.report is not None)
    cell.publish()
    states.append(cell.world.snapshot().value(device, DEVICE_STATE))
    cell.stops.clear()
    states.append(cell.world.snapshot().value(device, DEVICE_STATE))
    assert states == ["Idle", "Fault", "Idle"]


def test_a_later_emergency_stop_replaces_a_protective_one(make: Make) -> None:
    reports = Reports()
    cell = make(reports)
    reports.fault = "it has bumped into something"
    wait_until(lambda: cell.stops.report == DeviceStop("protective-stop", "it has bumped into something"))
    reports.fault = DeviceStop("emergency-stop", "pressed")
    wait_until(lambda: cell.stops.report == reports.fault)


def test_a_stop_is_acknowledged_by_the_devices_or_stays(make: Make) -> None:
    reports = Reports()
    cell = make(reports)
    reports.fault, reports.persists = "it has bumped into something", "move it away first"
    wait_until(lambda: cell.stops.report is not None)
    with pytest.raises(StopPersists, match="move it away first"):
        cell.stops.clear()
    assert cell.stops.report is not None
    reports.persists = None
    cell.stops.clear()
    assert cell.stops.report is None


def test_a_device_that_cannot_be_stopped_keeps_no_other_from_it_and_is_named(make: Make) -> None:
    reports, bad, good, gripper = Reports(), Device(fails=True), Device(), Device()
    cell = make(reports, arms={ARM["iiwa_table"]: bad, LAB + "Robotiq-1": good}, grippers={"g": gripper})
    reports.fault = "it has bumped into something"
    wait_until(lambda: not good.moving and not gripper.moving)
    wait_until(lambda: "no route to the device" in str(cell.stops.report))
    assert "it has bumped into something" in str(cell.stops.report)


def test_what_was_recorded_is_handed_over_in_the_thread_that_waits(make: Make) -> None:
    passed: list[float] = []
    cell = make(Reports(), passed=lambda: passed.append(0.0))
    cell.advance(0.001)
    cell.advance(0.001)
    assert len(passed) == 2


class Inspection(Camera):
    """A camera that has looked at a clean surface."""

    def inspect(self, surface: str) -> float:
        return 1.0

    def rubbed_share(self, surface: str, seconds: float) -> float:
        return 1.0


def test_what_its_camera_inspects_is_sensed(make: Make) -> None:
    cell = make(Reports(), inspection=Inspection())
    inspect = Inspect(cell, surface=SURFACE["iiwa_table"])
    inspect.start()
    inspect.tick()
    write = cell.world.deciding_write(PropertyFact(SURFACE["iiwa_table"], IS_CLEAN))
    assert write is not None
    assert write.evidence == "sensed"
