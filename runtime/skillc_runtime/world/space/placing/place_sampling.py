"""Which of many free places are tried: near each other at first, sparser farther away."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, islice, zip_longest
from typing import Final, TypeVar

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose

T = TypeVar("T")

PITCH_M: Final = 0.01
"""How far from each other the places are among which the first is chosen."""

MOST: Final = 60
"""How many other places of a support are tried."""

APART_M: Final = 0.03
APART_SHARE: Final = 0.4
"""How far from each other the places are at least that are tried: in m, and more as a share of how far the first is."""

NARROW_SHARE: Final = 0.25
"""The places are not farther apart than this share of half the narrower side of a support."""

TURNED_M: Final = 0.03
"""How far away a place counts at which the hand is turned otherwise."""

COARSE: Final = 40
"""Into how many parts the longer side of a support is divided at least to find places."""


def choose_pitch_m(half: Array) -> float:
    """Return how far from each other other places of a support with half sides (2,) in m are looked for, in m."""
    return max(PITCH_M, round(2.0 * float(half.max()) / COARSE, 3))


def spread_out(hands: Iterable[Pose], half: Array) -> Iterator[Pose]:
    """Yield the first of some poses of `hands` in the world, and a part of the others, in their order, that are apart.

    half (2,): half the sides in m of the support on which they are.
    """
    return islice(_thin_out(hands, min(APART_M, NARROW_SHARE * float(half.min()))), 1 + MOST)


def interleave(series: Sequence[Iterable[T]]) -> Iterator[T]:
    """Yield the first of each series, then the second of each that has one, and so on."""
    missing = object()
    for each in chain.from_iterable(zip_longest(*series, fillvalue=missing)):
        if each is not missing:
            yield each  # type: ignore[misc]


def _thin_out(hands: Iterable[Pose], apart_m: float) -> Iterator[Pose]:
    places, turns = list[Array](), list[Array]()
    for each in hands:
        if places:
            away = np.linalg.norm(np.array(places) - each.position, axis=1)
            turned = np.abs(np.array(turns) - each.rotation).max(axis=(1, 2)) > 0.5
            if (away + TURNED_M * turned < apart_m + APART_SHARE * float(away[0])).any():
                continue
        places.append(each.position)
        turns.append(each.rotation)
        yield each
