"""The link against a robot that others simulate: what it measures, commands, says of its stops, and how it ends."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from time import sleep
from typing import Any

import mujoco
import numpy as np
import pytest

from robots.franka.running import Peer, own_address
from skillc_ontology import catalogue
from skillc_runtime.backends.control_process.link import (
    KINDS,
    ControlRefused,
    PointMass,
    make_command,
    make_state,
)
from skillc_runtime.backends.franka.link import FrankaDescription, FrankaLink
from skillc_runtime.devices.backend import BackendUnavailable

pytestmark = [pytest.mark.robot, pytest.mark.slow]

STATE, COMMAND = make_state(7), make_command(7)
COMMAND.kind[0] = KINDS.index("torque")
HAND_KG = 0.76
NOTHING = PointMass(0.0, np.zeros(3))


def description(address: str) -> FrankaDescription:
    """Return what the facts of a Franka Research 3 say."""
    return FrankaDescription(address, catalogue.model_path("robots/fr3.xml"), rest_torque_n_m=2.5)


@pytest.fixture
def link(before: Peer) -> Iterator[FrankaLink]:
    reflex = (80.0,) * 4 + (12.0,) * 3, (100.0,) * 3 + (30.0,) * 3
    link = replace(description(before.address), reflex_torques=reflex[0], reflex_forces=reflex[1]).make_link()
    link.connect()
    yield link
    link.close()


def hold(link: FrankaLink, cycles: int, push: float = 0.0) -> str:
    """Hold the joints by springs, and push the last one; return the condition once control is lost, or in the end."""
    link.read(STATE)
    start = STATE.q.copy()
    for _ in range(cycles):
        link.read(STATE)
        if link.condition.kind != "in-control":
            break
        COMMAND.values[:] = 100.0 * (start - STATE.q) - 10.0 * STATE.dq
        COMMAND.values[6] += push
        link.write(COMMAND)
    return link.condition.kind


def raw(link: FrankaLink) -> Any:
    """Return a state of now as the library has it, without control."""
    for _ in range(20):
        state = link._robot.read_once()
    return state


def test_the_flange_of_the_model_is_that_of_the_robot(link: FrankaLink) -> None:
    link.read(STATE)
    state = raw(link)
    tool, on_flange = (np.reshape(each, (4, 4)).T for each in (state.O_T_EE, state.F_T_EE))
    robot_flange = tool @ np.linalg.inv(on_flange)
    model: Any = mujoco.MjModel.from_xml_path(str(catalogue.model_path("robots/fr3.xml")))
    data = mujoco.MjData(model)
    data.qpos[:] = STATE.q
    mujoco.mj_forward(model, data)
    flange = data.site("flange")
    np.testing.assert_allclose(flange.xpos, robot_flange[:3, 3], atol=1e-4)
    turned = robot_flange[:3, :3].T @ flange.xmat.reshape(3, 3)
    np.testing.assert_allclose(turned[:, 0], [np.sqrt(0.5), -np.sqrt(0.5), 0.0], atol=1e-4)
    lift = np.zeros((3, 7))
    mujoco.mj_jacSite(model, data, lift, None, flange.id)
    np.testing.assert_allclose(STATE.effort, data.qfrc_bias + HAND_KG * 9.81 * lift[2], atol=0.2)


def test_torques_are_commanded_in_steps_that_the_robot_takes_and_move_it(link: FrankaLink, before: Peer) -> None:
    link.take_control("torque")
    assert hold(link, 300) == "in-control"
    held = STATE.q.copy()
    assert hold(link, 200, push=3.0) == "in-control"
    assert STATE.q[6] - held[6] > 0.005
    assert abs(STATE.q - held)[:6].max() < 0.01
    link.give_back()
    assert link.condition.kind == "ready"
    report = before.ask("report")
    assert report["commands"] >= 500
    assert report["violations"] == []
    assert 0.5 < report["greatest_step"] < 1.0


def test_the_proxy_finds_what_is_beyond_limits(link: FrankaLink, before: Peer) -> None:
    control = link._robot.start_torque_control()
    control.readOnce()
    control.writeOnce(link._library.Torques([0.0] * 6 + [11.0]))
    control.readOnce()
    control.writeOnce(link._library.Torques([0.0] * 6 + [13.0]))
    control.readOnce()
    found = " ".join(before.ask("report")["violations"])
    assert "torque changes by 11.000 N m in 1 ms" in found
    assert "torque [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 13.0]" in found


def test_a_load_is_told_in_the_frame_of_the_robots_flange_without_losing_control(link: FrankaLink) -> None:
    link.take_control("torque")
    assert hold(link, 50) == "in-control"
    link.set_load(PointMass(0.73, np.zeros(3)), PointMass(0.2, np.array([0.0, 0.1, 0.12])))
    assert hold(link, 50) == "in-control"
    link.give_back()
    state = raw(link)
    assert state.m_load == pytest.approx(0.2)
    np.testing.assert_allclose(state.F_x_Cload, [0.1 * np.sqrt(0.5), 0.1 * np.sqrt(0.5), 0.12], atol=1e-6)
    assert np.linalg.eigvalsh(np.reshape(state.I_load, (3, 3))).min() > 0.0
    link.set_load(NOTHING, NOTHING)
    assert raw(link).m_load == 0.0


@pytest.mark.parametrize(
    ("mode", "kind", "says"),
    [
        (0, "wrong-mode", "unlock its joints and activate FCI in Desk"),
        (2, "not-in-control", "another program or an app in Desk moves the robot; end it"),
        (3, "wrong-mode", "the robot is guided by hand"),
        (6, "wrong-mode", "the robot recovers from an error; wait"),
    ],
)
def test_a_robot_in_a_mode_without_control_says_what_to_do(
    link: FrankaLink, before: Peer, mode: int, kind: str, says: str
) -> None:
    before.tell(f"mode {mode}")
    raw(link)
    link.read(STATE)
    assert link.condition.kind == kind
    with pytest.raises(ControlRefused, match=says):
        link.take_control("torque")
    before.tell("release")
    raw(link)
    link.take_control("torque")
    assert hold(link, 20) == "in-control"
    assert before.ask("report")["violations"] == []


def test_a_robot_that_is_not_the_one_of_the_facts_gets_no_command(
    link: FrankaLink, before: Peer, simulated: Peer
) -> None:
    def refuse(says: str, hand_kg: float = 0.73) -> None:
        link.set_load(PointMass(hand_kg, np.array([0.0, 0.0, 0.03])), NOTHING)
        raw(link)
        with pytest.raises(ControlRefused, match=says):
            link.take_control("torque")

    before.tell("swap 4 6")
    refuse(r"its flange is \d+ mm and \d+ deg away .* is that of another one")
    before.tell("swap 0 0")
    refuse(r"its end effector in Desk has 0.73 kg, the hand of the facts 1.50 kg", 1.5)
    simulated.ask("carry 1.5")
    sleep(1.0)
    refuse(r"N m on joint \d .* its load or tool is another one")
    simulated.ask("carry -1.5")
    sleep(1.0)
    assert before.ask("report")["commands"] == 0
    link.take_control("torque")
    assert hold(link, 20) == "in-control"


def test_commands_of_another_kind_are_refused(link: FrankaLink) -> None:
    with pytest.raises(ControlRefused, match="takes torques, and no commands of the kind 'position'"):
        link.take_control("position")


def test_a_reflex_is_told_with_its_cause_and_recovered_from(link: FrankaLink, before: Peer) -> None:
    link.take_control("torque")
    assert hold(link, 50) == "in-control"
    before.tell("reflex cartesian_reflex")
    assert hold(link, 500) == "protective-stop"
    link.read(STATE)
    assert "the force on the tool was above what counts as a collision" in link.condition.sentence
    with pytest.raises(ControlRefused, match="cartesian_reflex"):
        link.take_control("torque")
    link.recover()
    link.take_control("torque")
    assert hold(link, 100) == "in-control"


def test_a_robot_that_gets_no_commands_stops_and_says_why(link: FrankaLink, before: Peer) -> None:
    link.take_control("torque")
    before.tell("strict")
    sleep(0.2)
    assert hold(link, 500) == "protective-stop"
    link.read(STATE)
    assert "too many commands came late or not at all" in link.condition.sentence
    link.recover()
    assert link.condition.kind == "ready"


def test_nobody_at_an_address_is_told_with_what_to_do() -> None:
    link = description(own_address()).make_link()
    with pytest.raises(BackendUnavailable, match=r"Connection to FCI refused.*skiros:DriverAddress.*activated in Desk"):
        link.connect()
