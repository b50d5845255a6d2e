"""Finds signals of an arm that cannot be true, once a control period, independently of what controls it.

With the step of a joint s = q - q_before and what its speed says of it, e = h (dq + dq_before) / 2, two sums forget
with the time T: gap' = gap - h gap / T + s - e and way' = way - h way / T + max(|s|, |e|). A speed that a filter delays
leaves a small gap, one of the wrong sign twice the way. Both are compared only of arms whose measurements come once a
period: of others it is not known over which time a step went. What measures noise or a motion never measures the same
twice. The wrench of a wrist is compared with the torques of the motors, which the momentum observer has.
"""

from __future__ import annotations

from math import exp, sqrt

import numpy as np

from skillc_runtime.control.momentum_observer import DAMPING, LAG_S, WINDOW_S, ObserverMemory, estimate_wrench
from skillc_runtime.control.supervision.signal_memory import (
    AMOUNT,
    BEYOND_RANGE,
    COMMANDED,
    COMPARES,
    CONTRADICTS,
    DIFFERS_S,
    EFFORT,
    FASTEST,
    FEELS,
    FLIPPED,
    FOUND,
    FROZEN,
    GAP,
    HIGH,
    JOINT,
    JUMPS,
    KNOWN,
    LAST_Q,
    LAST_SPEED,
    LATE,
    LOADED,
    LOST,
    LOW,
    MOST_N,
    NOTHING,
    OLD_S,
    OLD_SPEED,
    REPEATS,
    SAME_S,
    SAME_SPEED_S,
    SAME_WRENCH_S,
    SUM,
    SUMMED_S,
    TOO_FAST,
    WAY,
    WRENCH_DIFFERS,
    WRENCH_FROZEN,
    WRENCH_JUMPS,
    SignalMemory,
    begin_signals,
    keep_signals,
    remember,
)
from skillc_runtime.devices.arm import ArmState
from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.numerics.linear import copy_vector
from skillc_runtime.motion.pose import Array

FORGETTING_S = 0.05
"""The time T."""

GAP_RAD, GAP_SHARE = 1e-3, 0.5
"""A greater gap than this and this share of the way is none of a filter, nor of noise."""

STALE_GAP_RAD = 1e-4
"""The same for speeds that have not changed at all for `FROZEN_S`."""

FROZEN_S, FROZEN_WRENCH_S = 0.008, 0.02
"""For how long joints, and the wrench while they move, are measured as exactly the same before they are frozen."""

MOVING_RAD_S = 0.01
"""A joint with this speed moves, so it cannot be at the same place."""

LOADED_N_M, LOADED_SHARE = 1.0, 0.01
"""Joints at the same place whose external torque seems to change by more than both, the share being of their effort,
are frozen: the torque that is commanded does not change them. Torques that are measured change with a joint that is
blocked."""

RANGE_RAD, SPEED_SHARE = 0.1, 4.0
"""How far joints may be beyond their range, and how many times its limit a speed may be."""

FLIPPED_RAD_S, FLIPPED_SHARE = 0.02, 0.2
"""Two joints at least with these speeds that have the opposite ones in the next period, up to this share, and no joint
that has not: no impact does that."""

JUMP_RAD = 0.02
"""How far joints may move in a period beyond what twice their greatest speeds allow."""

WRENCH_JUMP_SHARE = 2.0
"""How many times the limit of the contact force a wrench cannot change by in a period: with 1 MN/m and 0.1 m/s a force
grows by 100 N in 1 ms."""

CONTRADICTION_SHARE, CONTRADICTION_S = 0.5, 0.035
"""Share of the limit of the contact force by which wrist and motors may differ, and for how long."""


@inlined
def check_signals(memory: SignalMemory, observer: ObserverMemory, state: ArmState, period: float, lost: float) -> bool:
    """Tell, once, whether what is measured cannot be true; to be called every `period` s, before momentum is observed.

    lost: s, all time lost between periods; after a gap there is nothing to compare with. That an arm is silent is for
    others to tell: what comes then is compared with what came last, over the time between.
    """
    numbers = memory.numbers
    if numbers[KNOWN] == 0.0 or numbers[LOST] != lost:
        begin_signals(memory, observer, state, lost)
        return False
    if numbers[FOUND] != NOTHING:
        return False
    remember(memory, observer, state, period)
    found = NOTHING
    if memory.facts[REPEATS] == 0.0 and _is_old(memory.joints, state):
        numbers[OLD_S] += period
    elif numbers[OLD_S] > FORGETTING_S:
        begin_signals(memory, observer, state, lost)
        return False
    else:
        elapsed = period + numbers[OLD_S]
        numbers[OLD_S] = 0.0
        found = _check_joints(memory, observer, state, elapsed)
    if found == NOTHING and memory.facts[FEELS] != 0.0:
        found = _check_wrench(memory, observer, state, period)
    keep_signals(memory, state)
    numbers[FOUND] = found
    return found != NOTHING


@inlined
def _is_old(joints: Array, state: ArmState) -> bool:
    """Tell whether all joints are measured exactly as in the period before."""
    same = True
    for j in range(state.q.size):
        same = same and state.q[j] == joints[LAST_Q, j] and state.dq[j] == joints[LAST_SPEED, j]
    return same


@inlined
def _check_joints(memory: SignalMemory, observer: ObserverMemory, state: ArmState, period: float) -> float:
    """Return what is implausible of the joints."""
    for j in range(state.q.size):
        found = _check_joint(memory, state, j, period)
        if found != NOTHING:
            return found
    if _are_flipped(memory.joints, state):
        return _report(memory.numbers, FLIPPED, 0, 0.0)
    return _check_repetition(memory, observer, state, period) if memory.facts[REPEATS] != 0.0 else NOTHING


@inlined
def _check_joint(memory: SignalMemory, state: ArmState, j: int, period: float) -> float:
    """Update the sums of a joint, and return what is implausible of it."""
    joints, numbers, kept = memory.joints, memory.numbers, max(0.0, 1.0 - period / FORGETTING_S)
    q, dq = state.q[j], state.dq[j]
    step, expected = q - joints[LAST_Q, j], 0.5 * period * (dq + joints[LAST_SPEED, j])
    joints[GAP, j] = kept * joints[GAP, j] + step - expected
    joints[WAY, j] = kept * joints[WAY, j] + max(abs(step), abs(expected))
    if abs(step) > 2.0 * joints[FASTEST, j] * period + JUMP_RAD:
        return _report(numbers, JUMPS, j, step)
    if not joints[LOW, j] - RANGE_RAD < q < joints[HIGH, j] + RANGE_RAD:
        return _report(numbers, BEYOND_RANGE, j, q)
    if abs(dq) > SPEED_SHARE * joints[FASTEST, j]:
        return _report(numbers, TOO_FAST, j, dq)
    if memory.facts[REPEATS] != 0.0 and abs(joints[GAP, j]) > GAP_RAD + GAP_SHARE * joints[WAY, j]:
        return _report(numbers, CONTRADICTS, j, joints[GAP, j])
    return NOTHING


@inlined
def _are_flipped(joints: Array, state: ArmState) -> bool:
    """Tell whether all joints that were moving have the opposite speeds now."""
    count = 0
    for j in range(state.q.size):
        before = joints[LAST_SPEED, j]
        if abs(before) > FLIPPED_RAD_S:
            if abs(state.dq[j] + before) >= FLIPPED_SHARE * abs(before):
                return False
            count += 1
    return count > 1


@inlined
def _check_repetition(memory: SignalMemory, observer: ObserverMemory, state: ArmState, period: float) -> float:
    """Return what is implausible as it is exactly the same for too long."""
    joints, numbers, same_q, same_speed, moves, worst = memory.joints, memory.numbers, True, True, False, -1
    loaded, rests = False, True
    for j in range(state.q.size):
        same_q = same_q and state.q[j] == joints[LAST_Q, j]
        same_speed = same_speed and state.dq[j] == joints[LAST_SPEED, j]
        moves, rests = moves or abs(state.dq[j]) > MOVING_RAD_S, rests and state.dq[j] == 0.0
        change = abs(observer.torque[j] - joints[LOADED, j])
        loaded = loaded or change > max(LOADED_N_M, LOADED_SHARE * joints[EFFORT, j])
        if abs(joints[GAP, j]) > STALE_GAP_RAD:
            worst = j
    if not same_q:
        copy_vector(observer.torque, joints[LOADED])
    numbers[SAME_S] = numbers[SAME_S] + period if same_q and same_speed else 0.0
    numbers[SAME_SPEED_S] = numbers[SAME_SPEED_S] + period if same_speed else 0.0
    least = max(FROZEN_S, 3.5 * period)
    if numbers[SAME_S] > least and (moves or (loaded and memory.facts[COMMANDED] != 0.0)):
        return _report(numbers, FROZEN, 0, numbers[SAME_S])
    if numbers[SAME_SPEED_S] > least and worst >= 0 and not (same_q and rests):
        return _report(numbers, OLD_SPEED, worst, numbers[SAME_SPEED_S])
    return NOTHING


@inlined
def _report(numbers: Array, found: float, joint: int, amount: float) -> float:
    numbers[JOINT], numbers[AMOUNT] = joint, amount
    return found


@inlined
def _check_wrench(memory: SignalMemory, observer: ObserverMemory, state: ArmState, period: float) -> float:
    """Return what is implausible of the wrench."""
    numbers, facts, last, now = memory.numbers, memory.facts, memory.wrench, state.wrench
    square, force, torque, fastest = 0.0, 0.0, 0.0, 0.0
    for i in range(3):
        square += (now[i] - last[i]) * (now[i] - last[i])
        force += now[i] * now[i]
        torque += now[3 + i] * now[3 + i]
    for j in range(state.q.size):
        fastest = max(fastest, abs(state.dq[j]))
    most = WRENCH_JUMP_SHARE * facts[MOST_N]
    if square > most * most:
        return _report(numbers, WRENCH_JUMPS, 0, sqrt(square))
    same = abs(force - last[6]) <= 1e-12 * last[6] and abs(torque - last[7]) <= 1e-12 * last[7]
    if not same:
        numbers[SAME_WRENCH_S] = 0.0
    elif fastest > MOVING_RAD_S:
        numbers[SAME_WRENCH_S] += period
    if facts[REPEATS] != 0.0 and numbers[SAME_WRENCH_S] > max(FROZEN_WRENCH_S, 3.5 * period):
        return _report(numbers, WRENCH_FROZEN, 0, sqrt(force))
    return _compare_wrench(memory, observer, state, period)


@inlined
def _compare_wrench(memory: SignalMemory, observer: ObserverMemory, state: ArmState, period: float) -> float:
    """Return whether the torques of the motors contradict the wrench, which is made as late as what these tell."""
    numbers, facts, wrench = memory.numbers, memory.facts, memory.wrench
    if facts[COMPARES] == 0.0:
        return NOTHING
    for i in range(3):
        wrench[SUM + i] += period * state.wrench[i]
    numbers[SUMMED_S] += period
    if observer.elapsed[0] != 0.0:
        return NOTHING
    felt, square, share = np.empty(6), 0.0, 1.0 - exp(-numbers[SUMMED_S] / LAG_S)
    estimate_wrench(felt, observer.torque, state.jacobian, DAMPING)
    for i in range(3):
        wrench[LATE + i] += share * (wrench[SUM + i] / numbers[SUMMED_S] - wrench[LATE + i])
        wrench[SUM + i] = 0.0
        square += (felt[i] - wrench[LATE + i]) * (felt[i] - wrench[LATE + i])
    numbers[SUMMED_S] = 0.0
    most = CONTRADICTION_SHARE * facts[MOST_N]
    if square <= most * most:
        numbers[DIFFERS_S] = 0.0
        return NOTHING
    numbers[DIFFERS_S] += WINDOW_S
    return _report(numbers, WRENCH_DIFFERS, 0, sqrt(square)) if numbers[DIFFERS_S] > CONTRADICTION_S else NOTHING
