"""Commands that come late, not evenly, or not at all, and arms that bear it."""

import numpy as np
import pytest
from cells import ARM, run, world
from hypothesis import given
from hypothesis import strategies as st

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.arms.command_link import EARLY_S, RANDOM, CommandLink, send
from skillc_runtime.devices.reality import set_reality
from skillc_runtime.primitives.move import MoveLinear
from skillc_runtime.world.state.model import WorldModel

PERIODS = 400


def line(delay_s: float, jitter_s: float, lost: float, period_s: float, seed: int) -> CommandLink:
    state = np.zeros(5)
    state[RANDOM] = seed
    return CommandLink(
        delay_s, jitter_s, lost, period_s, np.zeros((int((delay_s + jitter_s) / period_s) + 3, 3)), state
    )


def send_numbers(link: CommandLink) -> list[tuple[int, float]]:
    """Send the number of each period; return what arrives, with the period."""
    target, found = np.full(2, np.nan), []
    for number in range(PERIODS):
        if send(link, np.array([number, -number], dtype=float), target):
            assert target[1] == -target[0]
            found.append((number, float(target[0])))
    return found


@given(st.floats(0.0, 0.012), st.floats(0.0, 0.004), st.sampled_from([0.001, 0.002, 0.004]), st.integers(1, 2**31 - 2))
def test_each_command_arrives_after_its_delay_in_order(
    delay_s: float, jitter_s: float, period_s: float, seed: int
) -> None:
    found = send_numbers(line(delay_s, jitter_s, 0.0, period_s, seed))
    late = [period_s * (at - sent) for at, sent in found]
    assert min(late) >= delay_s - 1e-6
    assert max(late) <= delay_s + jitter_s + period_s + EARLY_S
    sent = [each for _, each in found]
    assert sent == sorted(set(sent))
    assert sent[-1] >= PERIODS - 2 - (delay_s + jitter_s) / period_s


@given(st.floats(0.05, 0.5), st.integers(1, 2**31 - 2))
def test_the_share_of_lost_commands_is_that_of_the_line(lost: float, seed: int) -> None:
    arrived = len(send_numbers(line(0.0, 0.0, lost, 0.001, seed))) / PERIODS
    assert arrived == pytest.approx(1.0 - lost, abs=6 * np.sqrt(lost * (1.0 - lost) / PERIODS))


def test_a_torque_arm_bears_the_delay_that_its_sheet_states() -> None:
    """Without regard to it an iiwa shakes itself to a stop from 3 ms on."""
    state = set_reality(world("iiwa_table"), "wide:commandDelay,commandJitter,lostCommands")
    there = SimulatedCell(WorldModel(state), 3)
    arm = there.arm(ARM["iiwa_table"])
    start = arm.motion.stopping_pose()
    target = type(start)(start.position - np.array([0.0, 0.0, 0.1]), start.rotation)
    run(there, MoveLinear(there, arm=ARM["iiwa_table"], target=target, speed=0.2))
    there.advance(0.3)
    assert arm.fault is None
    assert np.linalg.norm(arm.measured.velocity[:3]) < 0.002
    assert np.linalg.norm(arm.measured.pose.position - target.position) < 0.002
