"""A series of trials: how each metric spreads, which seeds failed and why, and whether all is as it should be."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median
from typing import Any

import msgspec

from skillc_runtime.evaluation.trials.targets import Metric, metric_values
from skillc_runtime.evaluation.trials.trial import Disturbance, Trial
from skillc_runtime.evaluation.trials.verdict import find_misses


class Spread(msgspec.Struct, frozen=True, kw_only=True):
    """A metric of one thing over all trials in which it was measured; `met` counts those that meet the target.

    `target` is in words, `bound` its number if there is one; `values` are in order of seed.
    """

    metric: str
    subject: str
    unit: str
    target: str
    bound: float | None
    least: float
    median: float
    greatest: float
    met: int
    values: tuple[float, ...]
    median_missed: str | None = None


class FailedSeed(msgspec.Struct, frozen=True, kw_only=True):
    """A seed whose trial is not as it should be, with the reasons and how reality differed."""

    seed: int
    reasons: tuple[str, ...]
    variation: str


class Series(msgspec.Struct, frozen=True, kw_only=True):
    """All trials of one task. `wanted` seeds were asked for; those of `passed` went as they should.

    In `unverified` of them the task finished, but the facts `assumed` were not sensed.
    """

    task: str
    disturbance: Disturbance
    wanted: int
    done: int
    passed: int
    spreads: tuple[Spread, ...]
    failed: tuple[FailedSeed, ...]
    trials: tuple[Trial, ...]
    unverified: int = 0
    assumed: tuple[str, ...] = ()

    @property
    def good(self) -> bool:
        """Whether every trial that was asked for went as it should, and the medians are on target as well."""
        return self.passed == self.wanted and not any(spread.median_missed for spread in self.spreads)


def judge_series(task: str, disturbance: Disturbance, wanted: int, trials: Sequence[Trial]) -> Series:
    """Judge the trials of a task, `wanted` of which were asked for."""
    ordered = tuple(sorted(trials, key=lambda trial: trial.seed))
    judged = [(trial, find_misses(trial, disturbance)) for trial in ordered]
    failed = tuple(FailedSeed(seed=t.seed, reasons=why, variation=t.variation) for t, why in judged if why)
    return Series(
        task=task,
        disturbance=disturbance,
        wanted=wanted,
        done=len(ordered),
        passed=len(ordered) - len(failed),
        spreads=compute_spreads(ordered, judged_by_targets=disturbance == "none"),
        failed=failed,
        trials=ordered,
        unverified=sum(trial.verified is False for trial in ordered),
        assumed=tuple(dict.fromkeys(fact for trial in ordered for fact in trial.assumed)),
    )


def compute_spreads(trials: Sequence[Trial], judged_by_targets: bool = True) -> tuple[Spread, ...]:
    """Return how each metric of each thing spreads over trials, in order of thing and metric."""
    found: dict[tuple[str, str], tuple[Metric[Any], list[float]]] = {}
    for each in (value for trial in trials for value in metric_values(trial)):
        found.setdefault((each.subject, each.metric.name), (each.metric, []))[1].append(each.value)
    by_subject = sorted(found.items(), key=lambda item: item[0][0])
    return tuple(_spread(metric, subject, got, judged_by_targets) for (subject, _), (metric, got) in by_subject)


def _spread(metric: Metric[Any], subject: str, got: Sequence[float], judged_by_targets: bool) -> Spread:
    middle = median(got)
    wanted = metric.median_target
    missed = wanted is not None and middle > wanted and judged_by_targets
    return Spread(
        metric=metric.name,
        subject=subject,
        unit=metric.unit,
        target=metric.wanted,
        bound=metric.target,
        least=min(got),
        median=middle,
        greatest=max(got),
        met=sum(map(metric.met, got)),
        values=tuple(got),
        median_missed=f"median {middle:.3g} {metric.unit}, wanted at most {wanted:g}" if missed else None,
    )
