"""What measured joints tell of wrong facts: units, order and signs of the joints of an arm."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from skillc_runtime.motion.pose import Array

BEYOND_RAD = 0.01
"""A joint may be measured so far beyond the end of its range."""
TELLING_RAD, NEAR_RAD = 0.2, 0.03
"""Joints that are exchanged, or turn the other way, are known if their homes differ by so much, and the arm would be as
near to its home."""
MOVES_RAD, MOVES_RAD_S = 0.01, 0.02
"""What counts as a motion: a joint has moved so far, with this speed at least."""
WEIGHS_N_M, WEIGHS_SHARE = 4.0, 0.5
"""A joint that carries so much by the model, and measures this share of it the other way, is opposite to the model."""


def find_beyond(names: Sequence[str], q: Array, ranges: Array) -> str | None:
    """Return that a joint is outside its range, and why; None if none is. q (nv,) and ranges (nv, 2): rad."""
    for name, value, (low, high) in zip(names, q, ranges, strict=True):
        if not low - BEYOND_RAD <= value <= high + BEYOND_RAD:
            return (
                f"{name} is at {value:.2f}, and the model reaches from {low:.2f} to {high:.2f} rad: is it in degrees, "
                "or are joints exchanged?"
            )
    return None


def find_confusion(names: Sequence[str], q: Array, home: Array) -> str | None:
    """Return that an arm would be at home if joints were exchanged, or turned the other way; q and home (nv,): rad."""
    off = [int(joint) for joint in np.flatnonzero(np.abs(q - home) > NEAR_RAD)]
    opposite = [each for each in off if abs(q[each] + home[each]) < NEAR_RAD and abs(home[each]) > TELLING_RAD / 2]
    if off and opposite == off:
        turned = " and ".join(names[each] for each in off)
        return f"the arm would be at home if {turned} turned the other way: is the sign of its angle that of the model?"
    if len(off) == 2 and abs(home[off[0]] - home[off[1]]) > TELLING_RAD:
        first, second = off
        if max(abs(q[first] - home[second]), abs(q[second] - home[first])) < NEAR_RAD:
            return (
                f"the arm would be at home if {names[first]} and {names[second]} were exchanged: is their order right?"
            )
    return None


def find_opposite_speeds(names: Sequence[str], q: Array, dq: Array) -> Iterator[str]:
    """Yield the joints whose speeds have the other sign than the change of their positions.

    q (n, nv) in rad and dq (n, nv) in rad/s: one row a measurement, in the order of time.
    """
    moved, speeds = q[-1] - q[0], np.nan_to_num(dq).mean(axis=0)
    for name, way, speed in zip(names, moved, speeds, strict=True):
        if abs(way) > MOVES_RAD and abs(speed) > MOVES_RAD_S and way * speed < 0:
            yield f"{name} moves by {way:+.2f} rad while it reports a speed of {speed:+.2f} rad/s"


def find_opposite_weights(names: Sequence[str], weight: Array, effort: Array) -> Iterator[str]:
    """Yield the joints that carry weight in the other direction than the model says; both (nv,) in N m."""
    for name, carries, measured in zip(names, weight, effort, strict=True):
        if abs(carries) > WEIGHS_N_M and measured * carries < -WEIGHS_SHARE * carries**2:
            yield (
                f"{name} measures {measured:+.1f} N m, and carries {carries:+.1f} N m by the model: it turns opposite "
                "to the model"
            )
