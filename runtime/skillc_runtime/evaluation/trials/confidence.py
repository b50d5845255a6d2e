"""Confidence intervals: of the probability that a trial passes, and of the mean of a metric."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan, cos, pi, sin, sqrt
from statistics import NormalDist, fmean, stdev

import msgspec

LEVEL = 0.95
"""The probability that an interval contains what it is an interval of."""

_BISECTIONS = 60


class Interval(msgspec.Struct, frozen=True):
    """The ends of a confidence interval at the level LEVEL."""

    low: float
    high: float


def compute_proportion_interval(successes: int, count: int) -> Interval:
    """Return the score interval of a probability, from `successes` in `count` > 0 trials. Wilson 1927.

    (p + z^2/2n +- z sqrt(p (1 - p)/n + z^2/4n^2)) / (1 + z^2/n), with z the normal quantile.
    """
    z = NormalDist().inv_cdf((1.0 + LEVEL) / 2.0)
    share, more = successes / count, z * z / count
    half = z * sqrt(share * (1.0 - share) / count + more / (4.0 * count))
    centre = share + more / 2.0
    return Interval(max(0.0, (centre - half) / (1.0 + more)), min(1.0, (centre + half) / (1.0 + more)))


def compute_mean_interval(values: Sequence[float]) -> Interval | None:
    """Return the interval of the mean, mean +- t s/sqrt(n), with Student's t; None for less than two values.

    Student 1908; it assumes that the mean of the values is about normally distributed.
    """
    if len(values) < 2:
        return None
    half = find_t_quantile(len(values) - 1) * stdev(values) / sqrt(len(values))
    return Interval(fmean(values) - half, fmean(values) + half)


def find_t_quantile(freedom: int) -> float:
    """Return the t of Student's distribution with P(|T| < t) = LEVEL, for `freedom` > 0 degrees of freedom."""
    low, high = 0.0, 1e3
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2.0
        low, high = (middle, high) if _t_probability(middle, freedom) < LEVEL else (low, middle)
    return high


def _t_probability(t: float, freedom: int) -> float:
    """Return P(|T| < t). Abramowitz and Stegun 1964, 26.7.3 and 26.7.4."""
    angle = atan(t / sqrt(freedom))
    if freedom == 1:
        return 2.0 * angle / pi
    term = total = cos(angle) if freedom % 2 else 1.0
    for number in range(3 if freedom % 2 else 2, freedom, 2):
        term *= (number - 1) / number * cos(angle) ** 2
        total += term
    return 2.0 / pi * (angle + sin(angle) * total) if freedom % 2 else sin(angle) * total
