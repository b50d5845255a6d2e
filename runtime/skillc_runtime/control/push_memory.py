"""Guarded pushes as numbers, advanced once a control period: approach, contact, and the force that is measured.

The measured force contains the force that accelerates the tool, so it is used only after the tool has approached with
a steady speed. What a sensor reads of nothing is its bias; what the torques of an arm tell then is the error of its
payload.
"""

from __future__ import annotations

from math import inf, isnan, nan
from typing import assert_never

import numpy as np

from skillc_runtime.control.momentum_observer import MEASURING, estimate_wrench
from skillc_runtime.control.supervision.safety import FEELS_FORCE, OBSERVES, SafetyMemory
from skillc_runtime.devices.arm import ArmState
from skillc_runtime.devices.guarded_push import Contact, GuardedPush, Standstill
from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.numerics.linear import times
from skillc_runtime.motion.pose import Array

STEADY_SHARE, STEADY_S = (2 / 3, 3 / 2), 0.02
"""A tool approaches steadily when its speed has been within these shares of the approach speed for this time."""

FALL_SHARE, FALL_S = 2.0, 0.01
"""A tool that has moved faster than this multiple of its approach speed for this time has lost contact; the arm brakes
it."""

SAMPLE_S = 0.01
"""Period with which forces are sampled."""

FREE_S, SETTLED_S = 0.1, 0.5
"""How long a tool has moved steadily, or pressed, before its force is sampled."""

FREE_SAMPLES = 50
"""The number of samples before contact that are kept, the first ones: what yields is touched before it is noticed."""

NO_PUSH, APPROACHING, PRESSING, HELD = 0.0, 1.0, 2.0, 3.0
"""Phases; a tool that is held neither approaches nor presses."""

GO_ON, APPROACH, PRESS, NO_CONTACT, SANK = 0.0, 1.0, 2.0, 3.0, 4.0
"""What the arm must do next: continue, push gently, push with the full force, or give the push up."""

(
    PHASE, ACTION, SPEED, TRAVEL_M, SURFACE, STEADY, DEPTH, FAST, LASTED, MOVED, AGE, TOTAL, COUNT, FREE_COUNT,
) = range(14)  # fmt: skip
AXIS, CONDITIONS = 14, 17
"""Entries of a push: phase and action as above; approach speed in m/s; travel and height of the surface in m, NaN
before contact; for how many s the approach has been steady; depth in m; for how many s the tool has moved too fast, has
been in contact, has moved steadily at all; since the last sample; sum in N and number of samples in contact, number
before. Then the unit axis (3,) out of the surface, in base, and the conditions."""

NO_CONDITION, STANDSTILL, CONTACT = 0.0, 1.0, 2.0
KIND, LIMIT, FOR_S, FROM_START_S, HELD_S, CONDITION_SIZE = range(6)
MOST_CONDITIONS = 8
"""Entries of a condition: share of the speed or force in N, times in s, and for how long it has been true."""

FREE = CONDITIONS + MOST_CONDITIONS * CONDITION_SIZE
SIZE = FREE + FREE_SAMPLES
"""Where the samples before contact begin, and the number of all entries."""

MOST_PUSHES = 4


def write_push(push: Array, wanted: GuardedPush, axis: Array) -> None:
    """Write a guarded push that begins to approach; axis (3,): the unit vector out of the surface, in base."""
    push[:] = 0.0
    push[SPEED], push[TRAVEL_M], push[SURFACE] = wanted.approach_m_s, wanted.travel.distance_m, nan
    push[AXIS:CONDITIONS] = axis
    if len(wanted.touch_conditions) > MOST_CONDITIONS:
        raise ValueError(f"a push has at most {MOST_CONDITIONS} conditions, not {len(wanted.touch_conditions)}")
    for number, condition in enumerate(wanted.touch_conditions):
        first = CONDITIONS + number * CONDITION_SIZE
        match condition:
            case Standstill(share=share, for_s=for_s, from_start_s=from_start_s):
                push[first : first + HELD_S] = STANDSTILL, share, for_s, from_start_s
            case Contact(force_n=force_n, for_s=for_s):
                push[first : first + HELD_S] = CONTACT, force_n, for_s, inf
            case never:
                assert_never(never)
    begin_approach(push)


@inlined
def begin_approach(push: Array) -> None:
    """Begin to approach, or approach again: the row (n,) of a push, in N, m and s."""
    push[PHASE], push[STEADY], push[DEPTH] = APPROACHING, 0.0, 0.0
    for number in range(MOST_CONDITIONS):
        push[CONDITIONS + number * CONDITION_SIZE + HELD_S] = 0.0


@inlined
def advance_approach(push: Array, speed: float, force_n: float, period: float) -> float:
    """Advance a push. Return an action: PRESS as soon as a condition is met, NO_CONTACT beyond the travel.

    push: (n,) in m, s and N, see `control.push_memory`.
    speed: m/s, to the surface.
    force_n: N, of the surroundings against the tool.
    period: s.
    """
    wanted, steady = push[SPEED], 0.0
    if STEADY_SHARE[0] * wanted < speed < STEADY_SHARE[1] * wanted:
        steady = push[STEADY] + period
    moved = push[STEADY] >= STEADY_S or steady >= STEADY_S
    push[STEADY] = max(push[STEADY], STEADY_S) if moved else steady
    push[DEPTH] += speed * period
    touched = False
    for number in range(MOST_CONDITIONS):
        condition = push[CONDITIONS + number * CONDITION_SIZE : CONDITIONS + (number + 1) * CONDITION_SIZE]
        if condition[KIND] == NO_CONDITION:
            break
        holds, long_s = moved and force_n > condition[LIMIT], condition[FOR_S]
        if condition[KIND] == STANDSTILL:
            holds = abs(speed) < condition[LIMIT] * wanted
            long_s = condition[FOR_S] if moved else condition[FROM_START_S]
        condition[HELD_S] = condition[HELD_S] + period if holds else 0.0
        touched = touched or condition[HELD_S] >= long_s
    if touched:
        return PRESS
    return NO_CONTACT if push[DEPTH] > push[TRAVEL_M] else GO_ON


@inlined
def advance_pressing(push: Array, speed: float, period: float) -> float:
    """Advance a push that presses; return APPROACH if contact was lost.

    push: (n,) in m, s and N.
    speed: m/s, in its direction.
    period: s.
    """
    push[FAST] = push[FAST] + period if speed > FALL_SHARE * push[SPEED] else 0.0
    push[LASTED] += period
    return APPROACH if push[FAST] >= FALL_S else GO_ON


@inlined
def is_sample_due(push: Array, period: float) -> bool:
    """Tell whether the force of a push (n,) is to be sampled in this period of `period` s."""
    if push[PHASE] == APPROACHING:
        push[MOVED] = push[MOVED] + period if push[STEADY] >= STEADY_S else 0.0
        measures = push[MOVED] >= FREE_S and push[COUNT] == 0.0
    else:
        measures = push[LASTED] >= SETTLED_S
    if not measures:
        return False
    push[AGE] += period
    if push[AGE] < SAMPLE_S - period / 2:
        return False
    push[AGE] = 0.0
    return True


@inlined
def add_sample(push: Array, force_n: float) -> None:
    """Add to a push (n,) a sample of the measured force in N, of nothing or of what is pressed."""
    if push[PHASE] == APPROACHING:
        if push[FREE_COUNT] < FREE_SAMPLES:
            push[FREE + int(push[FREE_COUNT])] = force_n
        push[FREE_COUNT] += 1.0
    else:
        push[TOTAL] += force_n
        push[COUNT] += 1.0


@inlined
def _felt_along(axis: Array, safety: SafetyMemory, state: ArmState) -> float:
    """Return the force in N along an axis (3,) by a sensor, or by the torques; NaN without either."""
    felt = np.empty(6)
    if safety.limits[FEELS_FORCE] != 0.0:
        return float(axis[0] * state.wrench[0] + axis[1] * state.wrench[1] + axis[2] * state.wrench[2])
    if safety.limits[OBSERVES] == 0.0:
        return nan
    estimate_wrench(felt, safety.observer.torque, state.jacobian, MEASURING)
    return float(axis[0] * felt[0] + axis[1] * felt[1] + axis[2] * felt[2])


@inlined
def _advance_push(
    push: Array, height: float, speed: float, force_n: float, safety: SafetyMemory, state: ArmState, period: float
) -> float:
    surface = push[SURFACE]
    if surface - height > push[TRAVEL_M]:  # false before contact
        return SANK
    if push[PHASE] == HELD:
        return GO_ON
    approaches = push[PHASE] == APPROACHING
    action = advance_approach(push, speed, force_n, period) if approaches else advance_pressing(push, speed, period)
    if is_sample_due(push, period):
        felt_n = _felt_along(push[AXIS:CONDITIONS], safety, state)
        if not isnan(felt_n):
            add_sample(push, felt_n)
    if action == PRESS:
        push[PHASE], push[FAST], push[LASTED] = PRESSING, 0.0, 0.0
        push[SURFACE] = height if isnan(surface) else surface
    elif action == APPROACH:
        begin_approach(push)
    return action


@inlined
def advance_pushes(pushes: Array, contact: Array, safety: SafetyMemory, state: ArmState, period: float) -> bool:
    """Advance all pushes; return whether one of them has an action.

    pushes: (n, m) in m, s and N, one a row.
    contact: (3,) in N, the force of the surroundings on the tool, in base.
    period: s.
    """
    acts, velocity, at = False, np.empty(3), state.tool.position
    for number in range(pushes.shape[0]):
        push = pushes[number]
        if push[PHASE] == NO_PUSH:
            continue
        times(state.jacobian[:3], state.dq, velocity)
        a, b, c = push[AXIS], push[AXIS + 1], push[AXIS + 2]
        height = a * at[0] + b * at[1] + c * at[2]
        speed = -(a * velocity[0] + b * velocity[1] + c * velocity[2])
        force_n = a * contact[0] + b * contact[1] + c * contact[2]
        push[ACTION] = _advance_push(push, height, speed, force_n, safety, state, period)
        acts = acts or push[ACTION] != GO_ON
    return acts
