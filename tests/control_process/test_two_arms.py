"""Two arms have a control process each: what happens to one stops the other, and neither waits for the other."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from control_process.still_link import StillDescription
from simulation.cells import LAB, world
from skillc_runtime.backends.control_process.link import LinkAbilities
from skillc_runtime.backends.control_process.opening import open_cell
from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.devices.backend import BackendBroken
from skillc_runtime.recording.mcap.sample_layout import SampledBlock
from skillc_runtime.recording.mcap.signal_tap import SignalTap
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import SKILLC
from waiting import LONG_S, wait_until

pytestmark = pytest.mark.robot
IIWA, UR5E = LAB + "Iiwa-1", LAB + "Ur5e-1"


def describe(facts: ArmSpec) -> StillDescription:
    abilities = LinkAbilities(facts.modes, wrench="without-weight" if facts.force_torque else "none")
    return StillDescription(tuple(facts.home.tolist()), abilities)


@pytest.fixture(scope="module")
def cell() -> Iterator[DeviceCell]:
    times = ("treeTimeout", "controlTimeout", "cycleTimeout")
    slow = [SetProperty(arm, SKILLC + name, 60.0) for arm in (IIWA, UR5E) for name in times]
    made = open_cell(WorldModel(world("two_robots").with_changes(slow)), describe)
    yield made
    made.close()


def remote(cell: DeviceCell, arm: str) -> RemoteArmDriver:
    found = cell._arms[arm]
    assert isinstance(found, RemoteArmDriver)
    return found


def test_both_are_recorded_beside_each_other(cell: DeviceCell) -> None:
    live, blocks = cell.capabilities.live, list[SampledBlock]()
    assert live is not None
    tap = SignalTap(live)
    tap.add(blocks.append)
    for _ in range(10):
        cell.advance(0.02)
    tap.remove(blocks.append)
    rows = np.concatenate([tap.layout.rows_of(each) for each in blocks])
    columns = [each.column for each in tap.layout.describe(lambda iri: iri.rpartition("#")[2])]
    for name in ("Iiwa-1", "Ur5e-1"):
        stamps = rows[:, columns.index(f"{name}/sensor/measured_s")]
        assert (np.diff(stamps[~np.isnan(stamps)]) >= 0.0).all()
        assert stamps[-1] > stamps[~np.isnan(stamps)][0]


def test_one_that_has_ended_stops_the_other(cell: DeviceCell) -> None:
    cell.arm(UR5E).motion.hold_position()
    remote(cell, IIWA).process.process.kill()
    wait_until(lambda: cell.stops.report is not None)
    assert "the control process of lab:Iiwa-1 has ended by signal 9" in str(cell.stops.report)
    with pytest.raises(BackendBroken, match="lab:Iiwa-1"):
        cell.advance(0.01)
    wait_until(lambda: "lab:Iiwa-1 has ended" in str(remote(cell, UR5E).take_fault()))
    assert remote(cell, UR5E).process.find_silence() is None


def test_a_process_that_is_asked_to_end_does(cell: DeviceCell) -> None:
    process = remote(cell, UR5E).process
    process.process.terminate()
    assert process.process.wait(LONG_S) == 0
    assert process.find_silence() == "the control process of lab:Ur5e-1 has ended with exit code 0"
