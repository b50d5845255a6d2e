"""A series of trials: the spread of each metric, the failed seeds with reasons, and whether all targets are met."""

from __future__ import annotations

from typing import Literal

import msgspec

from skillc_runtime.evaluation.trials.confidence import Interval
from skillc_runtime.evaluation.trials.trial import Trial, TrialDisturbance


class Spread(msgspec.Struct, frozen=True, kw_only=True):
    """A metric of one object over all trials in which it was measured; `met` is the number that meet the target.

    `low_quartile` and `high_quartile` enclose the middle half of the values; `mean_interval` is the confidence
    interval of the `mean`, None for a single value. `target` is the target as text, `bound` its value, None without a
    target; small values are the better ones if `sense` is `at most`. `values` are in the order of `seeds`, those of the
    trials in which they were measured.
    """

    metric: str
    subject: str
    unit: str
    target: str
    bound: float | None
    least: float
    median: float
    greatest: float
    low_quartile: float
    high_quartile: float
    mean: float
    mean_interval: Interval | None
    met: int
    values: tuple[float, ...]
    seeds: tuple[int, ...] = ()
    sense: Literal["at-least", "at-most"] = "at-most"
    median_missed: str | None = None


class FailedSeed(msgspec.Struct, frozen=True, kw_only=True):
    """A seed whose trial failed, with the reasons and how reality differed from the world model."""

    seed: int
    reasons: tuple[str, ...]
    variation: str


class Series(msgspec.Struct, frozen=True, kw_only=True):
    """All trials of one task: `wanted` were requested, `done` were run, and `passed` of these met all criteria.

    `pass_interval` is the confidence interval of the probability to pass, from the trials that were done; None if none
    was. In `unverified` trials the task finished, but the facts `assumed` were not sensed. `false_successes` are trials
    that succeeded although the world model claims something false about things. `mean_wall_time_s` is the mean of
    the wall times of those trials that were run now, None if none was.
    """

    task: str
    disturbance: TrialDisturbance
    wanted: int
    done: int
    passed: int
    pass_interval: Interval | None
    spreads: tuple[Spread, ...]
    failed: tuple[FailedSeed, ...]
    trials: tuple[Trial, ...]
    unverified: int = 0
    assumed: tuple[str, ...] = ()
    false_successes: int = 0
    mean_wall_time_s: float | None = None

    @property
    def is_good(self) -> bool:
        """Whether all requested trials passed and all medians meet their targets."""
        return self.passed == self.wanted and not any(spread.median_missed for spread in self.spreads)
