"""Runs all that a control period may run, without the device, so that nothing is loaded or compiled once it moves."""

from __future__ import annotations

import numpy as np

from skillc_runtime.backends.control_process.link import RobotLink, make_state
from skillc_runtime.backends.control_process.periods.controlled_arm import ControlledArm
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.devices.guarded_push import GuardedPush, Travel

PERIODS = 20


def rehearse(facts: ArmSpec, names: dict[str, str], link: RobotLink) -> None:
    """Control a copy of the arm that stays at home, with its joints, its tool and a push, one after the other."""
    arm, measured = ControlledArm(facts, names, link.abilities, link.period_s), make_state(facts.home.size)
    measured.buffer[:], measured.speed_share[:] = 0.0, 1.0
    measured.q[:] = measured.target[:] = facts.home
    now = 0.0

    def run() -> None:
        nonlocal now
        for _ in range(PERIODS):
            now += link.period_s
            arm.step(measured, now)

    arm.begin(measured, now)
    run()
    arm.driver.motion.hold_position()
    run()
    along = arm.driver.measured.pose.rotation[:, 2].copy()
    arm.driver.compliance.release(along)
    push = arm.driver.compliance.start_push(GuardedPush(-along, 1.0, 0.01, Travel(0.1)))
    run()
    arm.driver.compliance.end_push(push)
    arm.driver.compliance.restore()
    run()
    assert np.isfinite(arm.driver.measured.q).all()
