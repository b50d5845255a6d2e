"""What is kept of the signals of an arm between control periods, and the speeds that follow from it without sensors."""

from __future__ import annotations

import msgspec
import numpy as np

from skillc_runtime.control.momentum_observer import ObserverMemory
from skillc_runtime.devices.arm import ArmLimits, ArmState
from skillc_runtime.motion.arrays import OutMatrix, OutVector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import cholesky, cholesky_solve

HISTORY_S, HISTORY = 0.005, 8
"""Every so many s a row is kept of what was measured, and how many of them there are."""

LAST_Q, LAST_SPEED, GAP, WAY, LOADED, GAINED, TAKEN, LOW, HIGH, FASTEST, EFFORT = range(11)
"""Rows of `SignalMemory.joints`. LAST_Q rad, LAST_SPEED rad/s: measured before; GAP, WAY rad: the sums; LOADED N m: the
external torque when joints began to be the same; GAINED N m s: all the impulse of motors and surroundings, and TAKEN
what it has of that of the observer; LOW, HIGH rad, FASTEST rad/s, EFFORT N m: limits."""

(
    KNOWN, LOST, SAME_S, SAME_SPEED_S, SAME_WRENCH_S, DIFFERS_S, SUMMED_S, AGE, NEXT, FOUND, JOINT, AMOUNT, OLD_S,
) = range(13)  # fmt: skip
"""Entries of `SignalMemory.numbers`. KNOWN: 1 if there is a measurement before; LOST s: time lost between periods until
then; SAME_S, SAME_SPEED_S, SAME_WRENCH_S: for how long joints, their speeds, the wrench are the same; DIFFERS_S: for
how long wrist and motors differ; SUMMED_S: since when forces of the wrist are added up; AGE s of the newest row of the
history, NEXT the row after it; FOUND: what is implausible, in what JOINT and by what AMOUNT; OLD_S: for how long no
new measurement of the joints has come, of an arm of which the same one may be an old one."""

REPEATS, FEELS, COMPARES, COMMANDED, MOST_N = range(5)
"""Entries of `SignalMemory.facts`: 1 if measurements that are the same are old ones, if there is a wrist, if it is
compared with the torques of the motors, and if these are commanded; the limit of the contact force in N."""

(
    NOTHING, FROZEN, OLD_SPEED, CONTRADICTS, FLIPPED, JUMPS, BEYOND_RANGE, TOO_FAST, WRENCH_FROZEN, WRENCH_JUMPS,
    WRENCH_DIFFERS,
) = (float(each) for each in range(11))  # fmt: skip
"""What is implausible."""


OF_WRIST = (WRENCH_FROZEN, WRENCH_JUMPS, WRENCH_DIFFERS)
"""Those of which the joints are still measured as they are."""

SUM, LATE = 8, 11
"""Where in `SignalMemory.wrench` the force of the wrist is added up, N s, and where it is as late as an observer, N."""


class SignalMemory(msgspec.Struct, frozen=True):
    """What is kept of the signals of an arm.

    joints (11, nv), numbers (13,), facts (5,): see above; wrench (14,): measured before, N and N m, the squares of
    its halves, SUM and LATE, see above; history (8, 3 nv): speeds in rad/s, GAINED and external torques, a row every
    `HISTORY_S`.
    """

    joints: OutMatrix
    numbers: OutVector
    facts: OutVector
    wrench: OutVector
    history: OutMatrix


def make_signal_memory(state: ArmState, limits: ArmLimits) -> SignalMemory:
    """Return the memory of an arm in a state, with nothing measured before."""
    count = state.q.size
    joints = np.zeros((11, count))
    joints[LOW], joints[HIGH] = limits.range[:, 0], limits.range[:, 1]
    joints[FASTEST], joints[EFFORT] = limits.velocity, limits.effort
    return SignalMemory(joints, np.zeros(13), np.zeros(5), np.zeros(14), np.zeros((HISTORY, 3 * count)))


@inlined
def begin_signals(memory: SignalMemory, observer: ObserverMemory, state: ArmState, lost: float) -> None:
    """Take what is measured now as the first measurement; lost: s, all time lost between periods."""
    joints, numbers, count = memory.joints, memory.numbers, state.q.size
    for i in range(numbers.size):
        numbers[i] = 0.0
    numbers[KNOWN], numbers[LOST] = 1.0, lost
    for j in range(count):
        joints[GAP, j], joints[WAY, j], joints[GAINED, j], joints[TAKEN, j] = 0.0, 0.0, 0.0, observer.impulse[j]
        joints[LOADED, j] = observer.torque[j]
    keep_signals(memory, state)
    for i in range(3):
        memory.wrench[SUM + i], memory.wrench[LATE + i] = 0.0, state.wrench[i]
    for row in range(HISTORY):
        _write_history(memory, observer, state, row)


@inlined
def keep_signals(memory: SignalMemory, state: ArmState) -> None:
    """Keep what is measured now, to be compared with the next measurement."""
    for j in range(state.q.size):
        memory.joints[LAST_Q, j], memory.joints[LAST_SPEED, j] = state.q[j], state.dq[j]
    wrench = memory.wrench
    for i in range(6):
        wrench[i] = state.wrench[i]
    wrench[6] = wrench[0] * wrench[0] + wrench[1] * wrench[1] + wrench[2] * wrench[2]
    wrench[7] = wrench[3] * wrench[3] + wrench[4] * wrench[4] + wrench[5] * wrench[5]


@inlined
def _write_history(memory: SignalMemory, observer: ObserverMemory, state: ArmState, row: int) -> None:
    history, count = memory.history, state.q.size
    for j in range(count):
        history[row, j], history[row, count + j] = state.dq[j], memory.joints[GAINED, j]
        history[row, 2 * count + j] = observer.torque[j]


@inlined
def remember(memory: SignalMemory, observer: ObserverMemory, state: ArmState, period: float) -> None:
    """Add the impulse of the last period of so many s, and write the history if it is due."""
    joints, numbers = memory.joints, memory.numbers
    fresh = observer.elapsed[0] == 0.0
    for j in range(state.q.size):
        before = 0.0 if fresh else joints[TAKEN, j]
        joints[GAINED, j] += observer.impulse[j] - before
        joints[TAKEN, j] = observer.impulse[j]
    numbers[AGE] += period
    if numbers[AGE] >= HISTORY_S - period / 2:
        numbers[AGE] = 0.0
        _write_history(memory, observer, state, int(numbers[NEXT]))
        numbers[NEXT] = (numbers[NEXT] + 1.0) % HISTORY


@compiled
def find_speeds(dq: OutVector, memory: SignalMemory, mass: OutMatrix) -> None:
    """Compute the speeds dq (nv,) in rad/s that an arm has now from the oldest ones that were kept, without sensors.

    M (dq - dq_0) = gained - gained_0 + r_0 t: the impulse of the motors since then is known, that of the surroundings
    goes on as it was. mass (nv, nv): M in kg m^2; it is overwritten.
    """
    oldest, count = int(memory.numbers[NEXT]), dq.size
    history, gained, faster = memory.history, np.empty(count), np.empty(count)
    passed = (HISTORY - 1) * HISTORY_S + memory.numbers[AGE]
    for j in range(count):
        since = memory.joints[GAINED, j] - history[oldest, count + j]
        gained[j] = since + passed * history[oldest, 2 * count + j]
    cholesky(mass)
    cholesky_solve(mass, gained, faster)
    for j in range(count):
        dq[j] = history[oldest, j] + faster[j]


def describe_signals(memory: SignalMemory) -> str:
    """Describe what is implausible."""
    numbers = memory.numbers
    amount, joint = float(numbers[AMOUNT]), int(numbers[JOINT]) + 1
    texts = {
        FROZEN: f"joints that should move are measured as exactly the same for {1e3 * amount:.0f} ms: their signals "
        "are frozen",
        OLD_SPEED: f"the measured speeds of the joints are exactly the same for {1e3 * amount:.0f} ms, but not the way "
        f"of joint {joint}: their signals are frozen",
        CONTRADICTS: f"what joint {joint} is measured to move contradicts its measured speed: one of them is wrong",
        FLIPPED: "the measured speeds of all joints have become the opposite within a control period: their sign is "
        "wrong",
        JUMPS: f"the measured position of joint {joint} jumps by {amount:.3f} rad, further than it can move",
        BEYOND_RANGE: f"joint {joint} is measured at {amount:.2f} rad, where it cannot be",
        TOO_FAST: f"joint {joint} is measured to move with {amount:.1f} rad/s, faster than it can",
        WRENCH_FROZEN: f"the force of {amount:.1f} N that the wrist measures is exactly the same while the arm moves: "
        "its signal is frozen",
        WRENCH_JUMPS: f"the force that the wrist measures jumps by {amount:.0f} N: an impact, or its signal is wrong",
        WRENCH_DIFFERS: f"the motors feel {amount:.0f} N that the wrist does not measure: its signal is wrong, or "
        "something touches the arm above it",
    }
    return texts[float(numbers[FOUND])]
