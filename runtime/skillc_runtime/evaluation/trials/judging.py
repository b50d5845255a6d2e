"""Judges series of trials."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import fmean, quantiles
from typing import Any

from skillc_runtime.evaluation.trials.confidence import compute_mean_interval, compute_proportion_interval
from skillc_runtime.evaluation.trials.series import FailedSeed, Series, Spread
from skillc_runtime.evaluation.trials.targets import Metric, list_trial_values
from skillc_runtime.evaluation.trials.trial import Trial, TrialDisturbance
from skillc_runtime.evaluation.trials.verdict import find_unmet_criteria


def judge_series(
    task: str, disturbance: TrialDisturbance, wanted: int, trials: Sequence[Trial], took_s: Sequence[float] = ()
) -> Series:
    """Judge the trials of a task, of which `wanted` were requested; `took_s` are the wall times of some, in s."""
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
        mean_wall_time_s=fmean(took_s) if took_s else None,
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
