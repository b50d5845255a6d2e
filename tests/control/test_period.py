"""A control period computes the same to the last bit as machine code and as plain Python, and the same as its parts."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from rig import Bench, moved_by

from skillc_runtime.control.limits import COMMANDED
from skillc_runtime.control.period import (
    BEYOND_LIMIT,
    IS_WATCHED,
    OVERLAY_OVER,
    PUSH_ACTS,
    TASK,
    TOOL_MOVED,
    control_by_forward_dynamics,
    control_by_impedance,
    copy_state,
)
from skillc_runtime.control.push_memory import MOST_PUSHES, PHASE, PRESSING
from skillc_runtime.control.supervision.safety import FORCE
from skillc_runtime.devices.guarded_push import GuardedPush, Travel
from skillc_runtime.motion.numerics.compiled import COMPILES, bind
from skillc_runtime.motion.numerics.places import fields_of, is_record
from skillc_runtime.motion.overlays import Circle, Lissajous
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import exp

LAWS = {"iiwa14": control_by_impedance, "ur5e": control_by_forward_dynamics}
PERIODS = 900


def twin(memory):
    """The same memory elsewhere."""
    if is_record(kind := type(memory)):
        return kind(*(twin(getattr(memory, name)) for name in fields_of(kind)))
    return memory.copy() if isinstance(memory, np.ndarray) else memory


def arrays(memory, path=""):
    """All arrays of a memory, with their names."""
    if is_record(type(memory)):
        for name in fields_of(type(memory)):
            yield from arrays(getattr(memory, name), f"{path}.{name}")
    elif isinstance(memory, np.ndarray):
        yield path, memory


def busy(robot):
    """An arm that presses, moves and has overlays, in a pause, with limits that it exceeds at times."""
    bench, chance = Bench(robot), np.random.default_rng(4)
    driver, start = bench.driver, bench.driver.motion.stopping_pose()
    out = -start.rotation[:, 2]
    driver.motion.move_along(
        path_through(
            [start, moved_by(start, 0.03, 0.02, 0, turn=(0, 0.1, 0)), moved_by(start, 0.0, 0.05, 0)],
            MotionLimits(0.1, 0.4, jerk=5.0),
            0.01,
        )
    )
    driver.motion.add_overlay(Circle(0.01, 0.5), exp(chance.uniform(-1, 1, 3)), 0.2)
    fading = driver.motion.add_overlay(Lissajous(*chance.uniform(0, 0.01, (3, 3))), np.eye(3), 0.3)
    driver.compliance.release(out)
    driver.compliance.release_rotation()
    driver.compliance.start_push(GuardedPush(out, 8.0, 0.05, Travel(0.5)))
    driver.motion.remove_overlay(fading)
    bench.run(0.001)
    memory = driver._period.memory
    memory.arm.safety.limits[FORCE] = 10.0
    assert len(memory.plan.table) == 2 and memory.pushes.shape[0] == MOST_PUSHES
    return bench, memory


@pytest.mark.slow
@pytest.mark.skipif(not COMPILES, reason="nothing is compiled here")
@pytest.mark.parametrize("robot", LAWS)
def test_machine_code_and_python_agree_to_the_last_bit(robot):
    bench, memory = busy(robot)
    other, chance, seen, pressed = twin(memory), np.random.default_rng(5), 0, 0
    compiled, plain, home = bind(LAWS[robot], memory), LAWS[robot].__wrapped__, bench.data.qpos.copy()
    known = dict(arrays(other))
    state = bench.state()
    for step in range(PERIODS):
        if step % 10 == 0:
            near = memory.law.limits[COMMANDED] if robot == "ur5e" else home
            bench.data.qpos[:] = near + chance.uniform(-1e-4, 1e-4, home.size)
            bench.data.qvel[:] = chance.uniform(-0.003, 0.003, home.size)
            state = replace(
                bench.state_at_rest(), wrench=chance.uniform(-1, 1, 6) * (20.0 if step % 300 == 290 else 1.0)
            )
        for each in (memory, other):
            copy_state(state, each.arm.state)
            if step == 700:
                each.arm.place[:] += 0.01
        for again in (False, True):
            for each in (memory, other):
                each.arm.clock[TASK], each.arm.clock[IS_WATCHED] = 0.001 * (1 + step), again
            events = compiled(0.0)
            assert events == plain(other, 0.0)
            seen |= events
            if not events & (TOOL_MOVED | BEYOND_LIMIT):
                break
        pressed += int(memory.pushes[0, PHASE] == PRESSING)
        for path, here in arrays(memory):
            np.testing.assert_array_equal(here, known[path], err_msg=f"{path} in period {step}")
    assert seen & PUSH_ACTS and seen & TOOL_MOVED and seen & OVERLAY_OVER and pressed > 100
    assert seen & BEYOND_LIMIT or robot == "iiwa14"
