"""A tool touches what it is to press on so slowly that its first impact stays below the limit of its arm."""

from math import inf

import numpy as np
import pytest
from cells import ARM, ERASER, GRIPPER, at_the_eraser, world
from hypothesis import given
from hypothesis import strategies as st

from skillc_runtime.primitives.approach_speed import find_greatest_approach, greatest_approach
from skillc_runtime.primitives.compliance import APPROACH_M_S, Push
from skillc_runtime.world.state.changes import AddRelation, SetProperty
from skillc_runtime.world.state.data_sheet import sheet_of
from skillc_runtime.world.state.terms import APPROACH_SPEED, CONTAIN, SKILLC

STEP_S = 1e-4


def hit(speed: float, stiffness: float, reaction_s: float, mass_kg: float) -> float:
    """Return the greatest force in N on a pad that a tool touches: it goes on for a while, then its mass is stopped."""
    way, greatest = speed * reaction_s, 0.0
    moving = speed
    for _ in range(round(10.0 / STEP_S)):
        force = stiffness * way
        moving -= STEP_S * force / mass_kg
        way += STEP_S * moving
        greatest = max(greatest, force)
        if moving < 0.0:
            break
    return greatest


@given(st.floats(20.0, 100.0), st.floats(3.0, 5.0), st.floats(0.0, 0.05), st.floats(1.0, 20.0))
def test_the_impact_stays_below_the_limit(most_n: float, power: float, reaction_s: float, mass_kg: float) -> None:
    stiffness = 10.0**power
    speed = greatest_approach(most_n, stiffness, reaction_s, mass_kg)
    assert speed == 0.005 or hit(speed, stiffness, reaction_s, mass_kg) <= 1.02 * most_n


def holding(scene: str, **stated: str) -> float:
    there = world(scene).with_changes([AddRelation(GRIPPER[scene], CONTAIN, ERASER)])
    sheet = sheet_of(there, ERASER).individual
    changes = [SetProperty(sheet, SKILLC + name, value) for name, value in stated.items()]
    return find_greatest_approach(there.with_changes(changes), ARM[scene], 8.0)


def test_an_arm_that_reacts_late_approaches_a_pad_more_slowly_than_one_that_yields() -> None:
    """The sheet says that the felt may be ten times as stiff; what it does not say is not made up."""
    assert 0.01 < holding("ur5e_whiteboard") < 0.025 < 0.05 < holding("iiwa_table")
    assert holding("ur5e_whiteboard", padStiffnessFactor="1.0 1.0") > 2 * holding("ur5e_whiteboard")
    assert find_greatest_approach(world("ur5e_whiteboard"), ARM["ur5e_whiteboard"], 8.0) == inf


@pytest.mark.parametrize(("scene", "is_slowed"), [("ur5e_whiteboard", True), ("iiwa_table", False)])
def test_a_push_is_slowed_before_it_moves_and_says_so(scene: str, is_slowed: bool) -> None:
    there = at_the_eraser(scene, changes=[AddRelation(GRIPPER[scene], CONTAIN, ERASER)])
    arm, up = there.arm(ARM[scene]), np.array([0.0, 0.0, 1.0])
    arm.compliance.release(up, 0.0)
    push = Push(there, arm=ARM[scene], along=up, force=8.0, travel=0.01)
    push.start()
    speed = there.world.snapshot().value(ARM[scene], APPROACH_SPEED)
    assert (speed is not None) == is_slowed
    assert push._push.approach_m_s == (speed if is_slowed else APPROACH_M_S)
    push.release()
