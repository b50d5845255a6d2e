"""A cell with a control thread: its devices stop although the tree is blocked, and it ends and breaks as it should."""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager

import numpy as np
import pytest

from backends.backend import scene_with
from backends.kinematic_runs import library, prepare
from simulation.cells import ARM
from skillc_ontology import catalogue
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.real_time.cell import RealTimeCell
from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.supervision.watchdog import HEARTBEAT_TIMEOUT_S
from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.devices.backend import BackendBroken
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DEVICE_STATE
from waiting import LONG_S

SCENE = "iiwa_table"


@contextmanager
def running(
    stop: Callable[[], bool] = lambda: False, pace: float = 1.0
) -> Iterator[tuple[RealTimeCell, KinematicCell]]:
    """Yield a cell with a control thread, and the cell inside."""
    inside = KinematicCell(scene_with(SCENE))
    cell = RealTimeCell(inside, stop, pace)
    try:
        yield cell, inside
    finally:
        cell.close()


def begin_to_move(cell: RealTimeCell) -> ArmDriver:
    """Begin a motion of several seconds."""
    arm = cell.arm(ARM[SCENE])
    start = arm.motion.stopping_pose()
    goal = Pose(start.position + np.array([0.0, 0.2, 0.0]), start.rotation)
    arm.motion.move_along(path_through([start, goal], MotionLimits(speed=0.05, acceleration=0.5)))
    return arm


def swing(cell: RealTimeCell) -> ArmDriver:
    """Begin a motion of several seconds, and return when the arm moves."""
    arm = begin_to_move(cell)
    cell.advance(0.5)
    assert speed(arm) > 0.04
    return arm


def speed(arm: ArmDriver) -> float:
    return float(np.linalg.norm(arm.measured.velocity[:3]))


def wait_until(holds: Callable[[], bool]) -> None:
    """Block, as a tick would that never ends, and let nobody else wait for the cell."""
    until = time.monotonic() + LONG_S
    while not holds():
        assert time.monotonic() < until, "the control thread does nothing"
        time.sleep(0.005)


@pytest.mark.slow
def test_a_blocked_tick_stops_the_devices_while_it_still_blocks() -> None:
    with running() as (cell, _):
        arm = swing(cell)
        silent_since = cell.now
        cell.watchdog.beat("run", silent_since)
        wait_until(lambda: speed(arm) < 1e-3)
        assert cell.now - silent_since > HEARTBEAT_TIMEOUT_S
        assert arm.take_fault() == "the tree is not ticked any more"
        assert not cell.watchdog.beat("run", cell.now)
        place = arm.measured.pose.position
        cell.advance(0.3)
        assert np.abs(arm.measured.pose.position - place).max() < 1e-4


@pytest.mark.slow
def test_a_client_that_gives_signs_of_life_is_not_stopped() -> None:
    with running(pace=0.25) as (cell, _):  # a busy machine may stand still for a second
        arm = swing(cell)
        for _ in range(50):
            assert cell.watchdog.beat("run", cell.now)
            cell.advance(0.01)
        assert arm.take_fault() is None
        assert speed(arm) > 0.04


def test_a_stop_from_outside_stops_the_devices_for_good() -> None:
    stop = threading.Event()
    with running(stop.is_set) as (cell, _):
        arm = swing(cell)
        stop.set()
        wait_until(lambda: speed(arm) < 1e-3)
        assert arm.take_fault() == cell.broken == "all devices were stopped from outside the run"
        with pytest.raises(BackendBroken, match="stopped from outside"):
            cell.advance(0.01)


def test_a_motion_that_is_started_after_a_stop_from_outside_does_not_move_the_arm() -> None:
    stop = threading.Event()
    with running(stop.is_set) as (cell, _):
        arm = swing(cell)
        stop.set()
        wait_until(lambda: speed(arm) < 1e-3 and cell.is_at_rest())
        place = arm.measured.pose.position
        begin_to_move(cell)
        after = cell.now + 0.3
        wait_until(lambda: cell.now > after)
        assert np.abs(arm.measured.pose.position - place).max() < 1e-3


def test_a_control_thread_that_dies_breaks_the_cell_with_the_reason() -> None:
    with running() as (cell, inside):
        swing(cell)

        def fail(now: float, steps: int) -> None:
            raise RuntimeError("the bus is gone")

        inside.steps.run = fail  # type: ignore[method-assign]
        with pytest.raises(BackendBroken, match=re.escape("the control thread has ended: RuntimeError('the bus")):
            cell.advance(10.0)
        assert cell.broken is not None
        assert cell.is_at_rest()
        with pytest.raises(BackendBroken):
            cell.advance(0.01)


def test_a_controller_that_cannot_go_on_is_reported_where_the_cell_is_advanced() -> None:
    with running() as (cell, inside):
        writers = set[int]()
        cell.world.subscribe(lambda _event: writers.add(threading.get_ident()))
        good = inside.arms[ARM[SCENE]]._q.copy()
        inside.arms[ARM[SCENE]]._q[:] = np.nan
        with pytest.raises(ControlError, match="not a number"):
            cell.advance(0.1)
        inside.arms[ARM[SCENE]]._q[:] = good
        assert cell.world.snapshot().value(ARM[SCENE], DEVICE_STATE) == "Fault"
        assert writers == {threading.get_ident()}, "the control thread writes nothing to the world model"


def test_a_closed_cell_stands_still() -> None:
    with running() as (cell, _):
        swing(cell)
        cell.close()
        cell.close()
        now = cell.now
        with pytest.raises(BackendBroken, match="closed"):
            cell.advance(0.1)
        assert cell.now == now
        assert cell.is_at_rest()


def test_calls_of_several_threads_and_control_periods_do_not_disturb_each_other() -> None:
    with running(pace=20.0) as (cell, _):
        arm, normal, failed = cell.arm(ARM[SCENE]), np.array([0.0, 0.0, 1.0]), list[Exception]()
        arm.motion.stopping_pose()

        def read() -> None:
            try:
                for _ in range(500):
                    assert np.isfinite(arm.measured.pose.rotation @ arm.measured.pose.rotation.T).all()
            except Exception as error:  # noqa: BLE001  the thread's boundary
                failed.append(error)

        readers = [threading.Thread(target=read) for _ in range(3)]
        for each in readers:
            each.start()
        for _ in range(40):
            arm.compliance.release(normal)
            cell.advance(0.01)
            arm.compliance.restore()
        for each in readers:
            each.join(LONG_S)
        assert not failed
        cell.advance(0.5)
        assert arm.motion.tracking_error_message is None


def test_the_same_commands_at_the_same_times_lead_to_the_same_place_as_in_lock_step() -> None:
    lock_step = KinematicCell(WorldModel(scene_with(SCENE).snapshot()))
    there = lock_step.arm(ARM[SCENE])
    goal = there.measured.q + 0.2
    there.motion.move_joints(goal, 0.5)
    lock_step.advance(3.0)
    with running(pace=10.0) as (cell, _):
        arm = cell.arm(ARM[SCENE])
        arm.motion.move_joints(goal, 0.5)
        cell.advance(3.0)
        assert arm.motion.done
        assert np.abs(arm.measured.q - there.measured.q).max() < 1e-6


@pytest.mark.sim
@pytest.mark.parametrize(("task", "scene"), [("press_button", "ur5e_button"), ("insert_peg_iiwa", "iiwa_peg")])
def test_a_shipped_task_succeeds_by_the_wall_clock(task: str, scene: str) -> None:
    compiled = library("contact")
    prepared = prepare(compiled, task, catalogue.scene_path(scene))
    inside = KinematicCell(WorldModel(prepared.assignment.state))
    with closing(RealTimeCell(inside, pace=0.5)) as cell:
        execution = execute_task(prepared, compiled, cell)
        assert execution.status == "succeeded", execution.failure
        assert execution.verified is False
        assert cell.is_at_rest()
        assert cell.secure() == ()


def test_a_control_period_that_never_ends_breaks_the_calls_that_wait_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("skillc_runtime.backends.real_time.locked.LOCK_S", 0.2)
    end, hangs = threading.Event(), threading.Event()

    def hang() -> bool:
        hangs.set()
        end.wait(LONG_S)
        return False

    with running(stop=hang) as (cell, _):
        assert hangs.wait(LONG_S)
        with pytest.raises(BackendBroken, match=r"has taken more than 0\.2 s"):
            cell.arm(ARM[SCENE]).motion.stopping_pose()
        end.set()
