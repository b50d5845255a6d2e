"""The line from a controller to an arm: commands come late, not evenly, and some not at all.

A command that is sent at t arrives at the next control period from t + delay + jitter u on, u in [0, 1) anew for each,
unless it is lost; none overtakes another, and of several that have arrived the newest counts. The delay is that of the
whole loop, from a measurement to the effect of what follows from it: for the loop it is the same where it arises.
"""

from __future__ import annotations

from math import ceil
from typing import Final
from zlib import crc32

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.devices.reality import Sizes
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.arrays import OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import inlined

MODULUS: Final = 2147483647.0
"""2^31 - 1, of the generator of Park and Miller (CACM 31(10), 1988): its products are exact in 64-bit floats."""

MULTIPLIER: Final = 48271.0

TIME, LAST, RANDOM, SENT, ARRIVED = range(5)
"""Entries of `CommandLink.state`: s by the periods that have passed; when the last command arrives; the last number of
the generator; how many commands were sent that are not lost, and how many of them have arrived."""

KINDS: Final = ("commandDelay", "commandJitter", "lostCommands")
"""The imperfections of a line, as in `devices.reality`."""

EARLY_S: Final = 1e-9
"""How much too early a command may arrive: periods add up with rounding errors."""


class CommandLink(msgspec.Struct, frozen=True):
    """The line of one arm.

    delay_s, jitter_s, lost: as above, lost being the share of lost commands; period_s: in which one is sent. queue
    (n, 1 + nv): of those on the way, a row each, when it arrives and its values. state (5,): see above.
    """

    delay_s: float
    jitter_s: float
    lost: float
    period_s: float
    queue: OutMatrix
    state: OutVector


@inlined
def send(link: CommandLink, values: Vector, target: OutVector) -> bool:
    """Send a command (nv,), N m, rad or rad/s; write what arrives in this period to `target` (nv,), and tell of it."""
    state, queue, arrived = link.state, link.queue, False
    rows = queue.shape[0]
    now = state[TIME] + link.period_s
    state[TIME] = now
    state[RANDOM] = (MULTIPLIER * state[RANDOM]) % MODULUS
    is_lost = state[RANDOM] < link.lost * MODULUS
    state[RANDOM] = (MULTIPLIER * state[RANDOM]) % MODULUS
    if not is_lost:
        arrives = now + link.delay_s + link.jitter_s * state[RANDOM] / MODULUS
        state[LAST] = max(state[LAST], arrives)
        row = int(state[SENT]) % rows
        queue[row, 0] = state[LAST]
        for j in range(values.size):
            queue[row, 1 + j] = values[j]
        state[SENT] += 1.0
    while state[ARRIVED] < state[SENT] and queue[int(state[ARRIVED]) % rows, 0] <= now + EARLY_S:
        row = int(state[ARRIVED]) % rows
        for j in range(target.size):
            target[j] = queue[row, 1 + j]
        state[ARRIVED] += 1.0
        arrived = True
    return arrived


def make_command_link(arm: ArmSpec, sizes: Sizes, seed: int, period_s: float) -> CommandLink | None:
    """Return the line to an arm that is commanded each `period_s` s; None if all arrives at once."""
    found = [sizes.get(each) for each in KINDS]
    if all(each is None for each in found):
        return None
    delay_s, jitter_s, lost = (0.0 if each is None else each[0] for each in found)
    rows = ceil((delay_s + jitter_s) / period_s) + 2
    state = np.zeros(5)
    state[RANDOM] = rng_for(arm.individual, seed, crc32(b"commandLink")).integers(1, int(MODULUS))
    return CommandLink(delay_s, jitter_s, lost, period_s, np.zeros((rows, 1 + arm.home.size)), state)


def find_greatest_delay(arm: ArmSpec) -> float:
    """Return by how many s a command may be late at most, by the sheet of an arm; 0 for one whose commands are not."""
    known = [each for each in KINDS[:2] if arm.reality.has_named(each) and arm.sheet.has(each)]
    return sum(float(arm.sheet.numbers(each)[1]) for each in known)
