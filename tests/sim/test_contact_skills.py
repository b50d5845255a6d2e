"""Work in contact, whole: done in cells that differ from what is believed, and told clearly where it cannot be done."""

from __future__ import annotations

import re

import numpy as np
import pytest
from contact_runs import LAB, at_rest, displace, run, strongest, tell, vanish

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.frames import pose

pytestmark = pytest.mark.sim


def test_a_button_is_pressed_with_the_force_it_wants() -> None:
    forces: list[float] = []
    done = run(
        "press_button", 1, watch=lambda cell: forces.append(float(cell.data.sensor("lab:Button-1/force").data[0]))
    )
    assert done.succeeded, done.why
    assert done.value("Button-1", "isOn") is True
    assert 9.0 < max(forces) < 12.5
    measured = done.value("Button-1", "pressedWith")
    assert isinstance(measured, float)
    assert 8.5 < measured < 11.5
    assert at_rest(done.cell)


def test_a_button_that_jams_is_told_with_the_force_it_was_pressed_with() -> None:
    def jam(cell: SimulatedCell) -> None:
        cell.model.jnt_range[cell.model.joint("lab:Button-1/cap").id] = (0.0, 0.001)

    done = run("press_button", change=jam, once=True)
    assert not done.succeeded
    assert done.why.startswith("lab:Button-1 has not switched within 2 s, pressed with ")
    assert done.value("Button-1", "isOn") is False
    assert at_rest(done.cell)


@pytest.mark.parametrize("task", ["press_button_panda", "polish_sheet_ur5e", "insert_peg_iiwa", "teach_pose_panda"])
def test_a_second_arm_does_the_same_work(task: str) -> None:
    done = run(task, 700)
    assert done.succeeded, done.why
    assert at_rest(done.cell)


def test_a_button_that_is_not_there_is_told() -> None:
    def leave_nothing(cell: SimulatedCell) -> None:
        for thing in ("Button-1", "Panel"):  # the fingers would meet the panel behind the button
            vanish(cell, thing)

    done = run("press_button", change=leave_nothing, once=True)
    assert not done.succeeded
    assert "nothing to push against within 10 cm" in done.why
    assert at_rest(done.cell)


def test_a_sheet_is_polished_with_an_even_force_and_a_swing_across_the_lanes() -> None:
    done = run("polish_sheet", 1)
    assert done.succeeded, done.why
    share = done.value("Sheet-1", "polishedShare")
    assert isinstance(share, float)
    assert share >= 0.99
    recorded = done.cell.ground_truth.recording(LAB + "Polisher-1")
    swinging = recorded.between(done.cell.now - 25.0, done.cell.now - 10.0)
    assert len(swinging.time) > 10_000
    assert swinging.force.mean() == pytest.approx(15.0, rel=0.02)
    assert swinging.force.min() > 0.5
    across = swinging.position[:, 1]
    frequency, amplitude = strongest(across, 0.001)
    assert frequency == pytest.approx(1.5, abs=0.1)
    assert 0.0115 < amplitude < 0.0155
    assert at_rest(done.cell)


def test_a_sheet_that_wants_more_rubbing_is_not_called_polished() -> None:
    done = run("polish_sheet", change=lambda cell: tell(cell, "Sheet-1", "polishTime", 60.0), once=True)
    assert not done.succeeded
    assert "isPolished" in done.why
    assert at_rest(done.cell)


def test_a_peg_finds_its_hole_and_stands_at_its_bottom() -> None:
    sinking: list[float] = []

    def watch(cell: SimulatedCell) -> None:
        arm = cell.arm(LAB + "Panda-1")
        if arm.compliance.commanded_wrench.any():
            sinking.append(-float(arm.measured.velocity[2]))

    done = run("insert_peg", 3, watch=watch)
    assert done.succeeded, done.why
    assert 0.03 < max(sinking) < 0.07
    (socket,), (true,) = done.cell.scene.fixtures, done.cell.variation.fixtures
    block = done.cell.data.body("lab:Peg-1/block")
    end = Pose(block.xpos, block.xmat.reshape(3, 3)).apply(np.array([0.0, 0.0, -0.03]))
    in_socket = true.true_pose(socket.pose).inverse().apply(end)
    assert in_socket[2] == pytest.approx(-0.030, abs=0.0005)
    assert abs(in_socket[:2]).max() < 0.0005
    measured = done.value("Peg-1", "insertedDepth")
    assert isinstance(measured, float)
    assert measured == pytest.approx(0.030, abs=0.002)
    assert done.cell.ground_truth.recording(LAB + "Peg-1").force.max() < 40.0
    assert at_rest(done.cell)


def test_a_hole_that_is_not_where_it_is_searched_for_is_told() -> None:
    done = run("insert_peg", change=lambda cell: displace(cell, "lab:Socket-1/block", (0.03, 0.0, 0.0)), once=True)
    assert not done.succeeded
    assert "nothing gave way within 45 s" in done.why
    assert done.value("Peg-1", "isSeated") is False
    assert at_rest(done.cell)


def test_a_hole_that_is_too_shallow_is_told_with_the_depth_that_was_reached() -> None:
    done = run("insert_peg", change=lambda cell: tell(cell, "Socket-1", "depth", 0.04), once=True)
    assert not done.succeeded
    assert "rests 3" in done.why
    assert "mm deep in lab:Socket-1, which is 40.0 mm deep" in done.why
    assert at_rest(done.cell)


def test_a_person_leads_the_tool_with_little_force_to_the_pose_that_is_taught() -> None:
    forces: list[float] = []
    path: list[Array] = []

    def watch(cell: SimulatedCell) -> None:
        force = float(np.linalg.norm(cell.data.body("lab:Robotiq-1/palm").xfrc_applied[:3]))
        if force > 0.0:
            forces.append(force)
            path.append(cell.arm(LAB + "Iiwa-1").measured.pose.position)

    done = run("teach_pose", 1, watch=watch)
    assert done.succeeded, done.why
    (person,) = done.cell.people
    taught = pose(done.cell.world.snapshot(), LAB + "Taught-1").position
    assert np.linalg.norm(taught - person.place) < 0.005
    assert np.linalg.norm(path[-1] - path[0]) > 0.05
    assert max(forces) < 25.0
    assert at_rest(done.cell)


def test_an_arm_that_nobody_leads_says_so_and_stays() -> None:
    def alone(cell: SimulatedCell) -> None:
        cell.people = ()

    done = run("teach_pose", change=alone, once=True)
    assert not done.succeeded
    assert "nobody guided the tool of lab:Iiwa-1 to a pose within 30 s: it is 0 mm from its start" in done.why
    assert done.value("Taught-1", "isTaught") is False
    assert at_rest(done.cell)


def test_a_tool_that_creeps_is_led_by_nobody() -> None:
    """A tenth of a newton, as what an arm gets wrong of its own weight: the tool moves some centimetres in 30 s."""

    def alone(cell: SimulatedCell) -> None:
        cell.people = ()

    def pull(cell: SimulatedCell) -> None:
        if cell.now > 4.0:
            cell.data.body("lab:Robotiq-1/palm").xfrc_applied[0] = 0.1

    done = run("teach_pose", change=alone, watch=pull, once=True)
    assert not done.succeeded
    assert re.search(r"nobody guided the tool of lab:Iiwa-1 to a pose within 30 s: it is \d\d mm from", done.why)
    assert done.value("Taught-1", "isTaught") is False
