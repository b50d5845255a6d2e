"""A tool that yields goes no faster than it may the way it is pushed, whoever pushes; the other way it is free."""

from __future__ import annotations

import numpy as np
from rig import GAINS, Bench

FASTEST_M_S = 0.04
PERSON_N = 30.0


def led(robot: str, direction: float, fastest_m_s: float, period: float = 0.001) -> np.ndarray:
    """Return the speeds in m/s along the way in which a free tool is pushed, while a person pushes it as well.

    direction: 1 for the same way, -1 for the opposite.
    """
    bench, speeds = Bench(robot, period=period), []
    driver = bench.driver
    way = driver.measured.pose.rotation[:, 2]
    driver.compliance.release(-way)
    driver.compliance.push(-way, 0.02 * GAINS[bench.robot].law.release_damping, fastest_m_s)
    bench.run(0.3)
    body = bench.model.body("eraser").id
    force, lever = direction * PERSON_N * way, driver.measured.pose.position - bench.data.xipos[body]
    bench.data.xfrc_applied[body] = np.concatenate([force, np.cross(lever, force)])
    bench.run(0.3, lambda: speeds.append(float(driver.measured.velocity[:3] @ way)))
    return np.array(speeds)


def test_a_tool_that_a_person_pushes_is_braked(robot):
    assert led(robot, 1.0, np.inf).max() > 0.2
    braked = led(robot, 1.0, FASTEST_M_S)
    assert FASTEST_M_S < braked[-100:].mean() < 0.1
    assert braked.max() < 0.12


def test_a_tool_that_a_person_pulls_back_is_not_braked(robot):
    """At first it may seem to touch something stiff."""
    assert np.allclose(*(led(robot, -1.0, each)[-100:] for each in (FASTEST_M_S, np.inf)), atol=0.02)


def test_it_is_braked_alike_at_every_rate(robot):
    ends = []
    for period in (0.001, 0.002, 0.004):
        speeds = led(robot, 1.0, FASTEST_M_S, period)
        assert np.abs(np.diff(speeds[len(speeds) // 2 :])).max() < 0.005, "it does not swing"
        ends.append(speeds[-len(speeds) // 4 :].mean())
    assert np.ptp(ends) < 0.003
