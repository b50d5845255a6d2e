"""A series of trials: the spread of each metric, the failed seeds with reasons, and whether all targets are met."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import fmean, quantiles
from typing import Any, Literal

import msgspec

from skillc_runtime.evaluation.trials.confidence import Interval, compute_mean_interval, compute_proportion_interval
from skillc_runtime.evaluation.trials.targets import Metric, list_trial_values
from skillc_runtime.evaluation.trials.trial import Disturbance, Trial
from skillc_runtime.evaluation.trials.verdict import find_unmet_criteria


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
    sense: Literal["at least", "at most"] = "at most"
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
    that succeeded although the world model claims something false about things.
    """

    task: str
    disturbance: Disturbance
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

    @property
    def is_good(self) -> bool:
        """Whether all requested trials passed and all medians meet their targets."""
        return self.passed == self.wanted and not any(spread.median_missed for spread in self.spreads)


def judge_series(task: str, disturbance: Disturbance, wanted: int, trials: Sequence[Trial]) -> Series:
    """Judge the trials of a task, of which `wanted` were requested."""
    ordered = tuple(sorted(trials, key=lambda trial: trial.seed))
    judged = [(trial, find_unmet_criteria(trial, disturbance)) for trial in ordered]
    failed = tuple(FailedSeed(seed=t.seed, reasons=why, variation=t.variation) for t, why in judged if why)
    passed = len(ordered) - len(failed)
    return Series(
        task=task,
        disturbance=disturbance,
        wanted=wanted,
        done=len(ordered),
        passed=passed,
        pass_interval=compute_proportion_interval(passed, len(ordered)) if ordered else None,
        spreads=compute_spreads(ordered, judged_by_targets=disturbance == "none"),
        failed=failed,
        trials=ordered,
        unverified=sum(trial.verified is False for trial in ordered),
        assumed=tuple(dict.fromkeys(fact for trial in ordered for fact in trial.assumed)),
        false_successes=sum(trial.is_false_success for trial in ordered),
    )


def compute_spreads(trials: Sequence[Trial], judged_by_targets: bool = True) -> tuple[Spread, ...]:
    """Return the spread of each metric of each object over the trials, ordered by object and metric."""
    found: dict[tuple[str, str], tuple[Metric[Any], list[tuple[int, float]]]] = {}
    for seed, each in ((trial.seed, value) for trial in trials for value in list_trial_values(trial)):
        found.setdefault((each.subject, each.metric.name), (each.metric, []))[1].append((seed, each.value))
    by_subject = sorted(found.items(), key=lambda item: item[0][0])
    return tuple(
        _compute_spread(metric, subject, measured, judged_by_targets) for (subject, _), (metric, measured) in by_subject
    )


def _compute_spread(
    metric: Metric[Any], subject: str, measured: list[tuple[int, float]], judged_by_targets: bool
) -> Spread:
    seeds, values = [seed for seed, _ in measured], [value for _, value in measured]
    low, middle, high = quantiles(values, n=4, method="inclusive") if len(values) > 1 else values * 3
    target = metric.median_target
    missed = target is not None and middle > target and judged_by_targets
    return Spread(
        metric=metric.name,
        subject=subject,
        unit=metric.unit,
        target=metric.target_text,
        bound=metric.target,
        least=min(values),
        median=middle,
        greatest=max(values),
        low_quartile=low,
        high_quartile=high,
        mean=fmean(values),
        mean_interval=compute_mean_interval(values),
        met=sum(map(metric.is_met, values)),
        values=tuple(values),
        seeds=tuple(seeds),
        sense=metric.sense,
        median_missed=f"median {middle:.3g} {metric.unit}, wanted at most {target:g}" if missed else None,
    )
