"""Either side killed or paused, stops, and a robot that somebody else has: the arm ends at rest, with the cause."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from control_process.toy_link import Toy, toy_cell
from simulation.cells import ARM
from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.devices.backend import BackendBroken, BackendUnavailable, StopPersists
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose
from skillc_runtime.recording.mcap.sample_layout import SampledBlock
from skillc_runtime.recording.mcap.signal_tap import SignalTap
from waiting import wait_until

pytestmark = pytest.mark.robot
SCENE = "iiwa_table"
SWING_M_S = 0.03


class SharedCell:
    """A robot and its cell for several tests; what a test has left stopped or ended is started again."""

    def __init__(self) -> None:
        self._toy: Toy | None = None
        self._cell: DeviceCell | None = None

    def find_toy(self) -> Toy:
        """Return the robot, without a cell."""
        self._close_cell()
        if self._toy is None:
            self._toy = Toy(SCENE)
        return self._toy

    def find(self) -> tuple[Toy, DeviceCell]:
        """Return both."""
        if self._cell is None or self._cell.stops.report is not None:
            self._cell = self.find_toy().open()
        assert self._toy is not None
        return self._toy, self._cell

    def close(self) -> None:
        self._close_cell()
        if self._toy is not None:
            self._toy.close()

    def _close_cell(self) -> None:
        if self._cell is not None:
            self._cell.close()
        self._cell = None


@pytest.fixture(scope="module")
def shared() -> Iterator[SharedCell]:
    found = SharedCell()
    yield found
    found.close()


@pytest.fixture
def both(shared: SharedCell) -> tuple[Toy, DeviceCell]:
    """A robot and its cell, in order and at rest."""
    toy, cell = shared.find()
    cell.secure()
    wait_until(cell.is_at_rest)
    assert cell.stops.report is None
    return toy, cell


def swing(cell: DeviceCell) -> ArmDriver:
    """Begin a slow motion of the tool; return its arm once it moves."""
    arm = cell.arm(ARM[SCENE])
    start = arm.motion.stopping_pose()
    way = -0.2 if start.position[1] > 0.0 else 0.2
    goal = Pose(start.position + np.array([0.0, way, 0.0]), start.rotation)
    arm.motion.move_along(path_through([start, goal], MotionLimits(speed=SWING_M_S, acceleration=0.5)))
    wait_until(lambda: float(np.linalg.norm(arm.measured.velocity[:3])) > 0.02 or cell.stops.report is not None)
    assert cell.stops.report is None
    return arm


def how_fast(arm: ArmDriver) -> float:
    """Return how fast the tool is commanded to move, in m/s, once that is steady."""
    time.sleep(0.3)
    return float(np.linalg.norm(arm.motion.reference.twist[:3]))


def remote(cell: DeviceCell) -> RemoteArmDriver:
    arm = cell._arms[ARM[SCENE]]
    assert isinstance(arm, RemoteArmDriver)
    return arm


def report(toy: Toy) -> dict[str, Any]:
    found: dict[str, Any] = toy.ask("report")
    return found


def is_still(toy: Toy) -> bool:
    return bool(np.abs(np.asarray(report(toy)["dq"])).max() < 0.02)


def stays_still(toy: Toy, seconds: float) -> bool:
    """Tell whether it is at rest for so long, by its own time."""
    until = report(toy)["time_s"] + seconds
    while report(toy)["time_s"] < until:
        if not is_still(toy):
            return False
        time.sleep(0.01)
    return True


def told(cell: DeviceCell) -> str:
    """Return why the cell breaks the next time that a run waits for it."""
    wait_until(lambda: cell.stops.report is not None)
    with pytest.raises(BackendBroken) as broken:
        cell.advance(0.01)
    return str(broken.value)


def test_cycles_are_recorded_with_what_was_lost_and_the_model_is_where_the_robot_is(
    both: tuple[Toy, DeviceCell],
) -> None:
    toy, cell = both
    arm, live, drawing = swing(cell), cell.capabilities.live, cell.capabilities.drawing
    assert live is not None
    assert drawing is not None
    tap, blocks = SignalTap(live), list[SampledBlock]()
    tap.add(blocks.append)
    for _ in range(10):
        cell.advance(0.02)
    tap.remove(blocks.append)
    columns = [each.column for each in tap.layout.describe(lambda _: "arm")]
    rows = np.concatenate([tap.layout.rows_of(each) for each in blocks])
    assert rows.shape[1] == len(columns)
    assert len(rows) > 50
    stamps, lost = rows[:, columns.index("arm/sensor/measured_s")], rows[:, columns.index("arm/sensor/lost_periods")]
    np.testing.assert_allclose(np.diff(stamps), 0.001, atol=1e-9)
    assert (np.diff(lost) >= 0).all()
    assert np.isfinite(rows[:, columns.index("arm/sensor/late_s")]).all()
    joint = int(drawing.model.joint(f"{drawing.prefixes[ARM[SCENE]]}joint1").qposadr[0])
    arm.motion.stop()
    wait_until(cell.is_at_rest)
    assert drawing.posture().joints[joint] == pytest.approx(float(np.asarray(report(toy)["q"])[0]), abs=1e-3)


def test_lost_states_are_counted_and_a_motion_goes_on(both: tuple[Toy, DeviceCell]) -> None:
    toy, cell = both
    before = remote(cell).process.read().number("lost")
    toy.ask("lose", 5)
    swing(cell)
    wait_until(lambda: remote(cell).process.read().number("lost") > before + 100)
    toy.ask("lose", 0)
    assert cell.stops.report is None
    assert report(toy)["violations"] == []


def test_an_arm_that_settles_is_waited_for_when_control_is_taken(both: tuple[Toy, DeviceCell]) -> None:
    toy, cell = both
    swing(cell)
    remote(cell).give_back()
    assert not is_still(toy)
    remote(cell).take_control()
    assert cell.stops.report is None
    swing(cell)


def test_a_robot_that_is_frozen_is_named_and_goes_on_once_it_is_acknowledged(both: tuple[Toy, DeviceCell]) -> None:
    toy, cell = both
    swing(cell)
    os.kill(toy.process.pid, signal.SIGSTOP)
    assert f"the toy robot at port {toy.port} has been silent for 2 s" in told(cell)
    os.kill(toy.process.pid, signal.SIGCONT)
    wait_until(lambda: is_still(toy))
    cell.stops.clear()
    assert cell.stops.report is None
    swing(cell)
    assert report(toy)["violations"] == []


def test_a_control_process_that_is_paused_is_named_and_goes_on_at_rest(both: tuple[Toy, DeviceCell]) -> None:
    toy, cell = both
    swing(cell)
    process = remote(cell).process.process
    os.kill(process.pid, signal.SIGSTOP)
    assert "the control process of lab:Iiwa-1 has not run for" in told(cell)
    wait_until(lambda: is_still(toy))
    os.kill(process.pid, signal.SIGCONT)
    wait_until(lambda: remote(cell).process.find_silence() is None)
    assert stays_still(toy, 0.2)
    cell.stops.clear()
    swing(cell)
    assert report(toy)["violations"] == []


@pytest.mark.parametrize(
    ("kind", "says"), [("protective-stop", "the toy has stopped by itself"), ("emergency-stop", "release it")]
)
def test_a_stop_of_the_robot_is_one_of_the_cell(both: tuple[Toy, DeviceCell], kind: str, says: str) -> None:
    toy, cell = both
    swing(cell)
    toy.ask("condition", kind)
    assert says in told(cell)
    assert cell.stops.report is not None
    assert cell.stops.report.kind == kind
    assert cell.is_at_rest()
    if kind == "emergency-stop":
        with pytest.raises(StopPersists, match="release it"):
            cell.stops.clear()
        toy.ask("condition", "ready")
    wait_until(lambda: is_still(toy))
    cell.stops.clear()
    assert cell.stops.report is None
    swing(cell)


def test_somebody_else_takes_control(both: tuple[Toy, DeviceCell]) -> None:
    toy, cell = both
    swing(cell).set_speed(0.8)
    toy.ask("condition", "not-in-control")
    assert "the panel of the toy has control" in told(cell)
    with pytest.raises(StopPersists, match="press Release"):
        cell.stops.clear()
    toy.ask("condition", "ready")
    wait_until(lambda: is_still(toy))
    cell.stops.clear()
    arm = swing(cell)
    assert how_fast(arm) == pytest.approx(0.8 * SWING_M_S, rel=0.02), "it has its share of the speeds still"
    arm.set_speed(1.0)


def test_a_control_process_that_is_killed_is_named_and_another_one_goes_on_once_that_is_acknowledged(
    both: tuple[Toy, DeviceCell],
) -> None:
    toy, cell = both
    cell.arm(ARM[SCENE]).set_speed(0.8)
    swing(cell)
    remote(cell).process.process.kill()
    assert "the control process of lab:Iiwa-1 has ended by signal 9" in told(cell)
    wait_until(lambda: is_still(toy))
    assert cell.is_at_rest()
    with pytest.raises(BackendBroken, match="has ended by signal 9"):
        cell.arm(ARM[SCENE]).motion.stopping_pose()
    cell.stops.clear()
    assert how_fast(swing(cell)) == pytest.approx(0.8 * SWING_M_S, rel=0.02), "it has its share of the speeds"
    cell.arm(ARM[SCENE]).set_speed(1.0)


TREE = """
import sys, time
from control_process.test_faults import SCENE, Toy, swing
cell = Toy(SCENE, running=(int(sys.argv[1]), int(sys.argv[2]))).open()
while True:
    swing(cell)
    print("moves", flush=True)
    while cell.stops.report is None:
        cell.watchdog.beat("tree", cell.now)
        time.sleep(0.01)
    cell.stops.clear()
"""


def test_the_process_of_the_tree_is_paused_and_goes_on_and_is_killed(shared: SharedCell) -> None:
    toy, tests = shared.find_toy(), Path(__file__).parent.parent
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(tests), *filter(None, sys.path)])}
    command = [sys.executable, "-c", TREE, str(toy.port), str(toy.panel_port)]
    tree = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment, cwd=tests)
    try:
        assert tree.stdout is not None
        assert tree.stdout.readline() == "moves\n"
        tree.send_signal(signal.SIGSTOP)
        wait_until(lambda: is_still(toy))
        assert report(toy)["condition"] == "in-control"
        tree.send_signal(signal.SIGCONT)
        assert tree.stdout.readline() == "moves\n"
        tree.kill()
        wait_until(lambda: report(toy)["condition"] == "ready" and is_still(toy))
        assert report(toy)["violations"] == []
    finally:
        tree.kill()
        tree.wait()


@pytest.mark.parametrize(("what", "how_much"), [("delay", 12), ("flip_speeds", 1)])
def test_what_makes_a_law_unstable_ends_at_rest(what: str, how_much: int) -> None:
    """Commands that come late, and speeds with the wrong sign, let an arm shake: it is stopped, or given back."""
    with toy_cell(SCENE) as (toy, cell):
        swing(cell)
        toy.ask(what, how_much)
        wait_until(lambda: cell.stops.report is not None)
        if what == "delay":
            wait_until(lambda: "did not come to rest, so control was given back" in str(cell.stops.report))
        wait_until(lambda: stays_still(toy, 1.0))
        assert report(toy)["violations"] == []


def test_a_robot_in_a_wrong_mode_opens_stopped_and_one_that_is_gone_is_named_with_what_to_do() -> None:
    toy = Toy(SCENE)
    try:
        toy.ask("condition", "wrong-mode")
        cell = toy.open()
        try:
            wait_until(lambda: cell.stops.report is not None)
            assert "turn the key" in str(cell.stops.report)
            assert report(toy)["commands"] == 0
            toy.ask("condition", "ready")
            cell.stops.clear()
            swing(cell)
            toy.process.kill()
            assert "the toy robot" in told(cell)
            with pytest.raises(StopPersists, match=r"does not answer.*start it"):
                cell.stops.clear()
            assert cell.is_at_rest()
        finally:
            cell.close()
        with pytest.raises(BackendUnavailable, match=r"the toy robot at port .* does not answer.*start it"):
            toy.open()
    finally:
        toy.close()
