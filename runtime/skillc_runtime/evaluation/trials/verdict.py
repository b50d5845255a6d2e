"""Judges a trial: undisturbed it must meet all targets, disturbed it must recover or give up safely."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from skillc_runtime.evaluation.measures.work import InsertingWork, PolishingWork, PressingWork, WipingWork
from skillc_runtime.evaluation.metrics.coverage_text import format_coverage
from skillc_runtime.evaluation.trials.targets import MetricValue, list_trial_values, list_work_values
from skillc_runtime.evaluation.trials.trial import Trial, TrialDisturbance


def find_unmet_criteria(trial: Trial, disturbance: TrialDisturbance) -> tuple[str, ...]:
    """Return the criteria that a trial does not meet, as text; empty if it passed."""
    if trial.status in ("refused", "crashed"):
        return (_describe_end(trial),)
    return (*_false_success(trial), *_outcome_problems(trial, disturbance), *_safety_problems(trial))


def find_failures(trial: Trial) -> tuple[str, ...]:
    """Return why an undisturbed trial is no success, as text, whatever its measures are; empty if it is one."""
    if trial.status in ("refused", "crashed"):
        return (_describe_end(trial),)
    return (*_false_success(trial), *_require_success(trial), *_safety_problems(trial))


def _outcome_problems(trial: Trial, disturbance: TrialDisturbance) -> Iterator[str]:
    """Yield how the outcome of the task differs from the expected one."""
    match disturbance:
        case "none":
            yield from _require_success(trial)
            yield from _unmet_targets(trial)
        case "push":
            if not trial.pushed:
                yield "there was no push: nothing is done along a path or in a search"
            yield from _require_success(trial)
            if trial.coverage is not None and trial.coverage < 1.0:
                yield f"coverage {format_coverage(trial.coverage)} %, wanted 100 % in the end"
        case "take":
            if not trial.taken:
                yield "nothing was taken: nothing is held for long enough"
            if trial.status == "failed" and not trial.reason:
                yield "failed, wanted a reason"
            if trial.status not in ("succeeded", "failed"):
                yield _describe_end(trial)
        case "missing":
            if trial.status != "failed" or not trial.reason:
                yield f"{trial.status}, wanted a failure that says why"
        case "obstacle":
            yield from _claimed_work(trial)
        case _:
            assert_never(disturbance)


def _false_success(trial: Trial) -> Iterator[str]:
    if trial.is_false_success:
        yield f"false success: {'; '.join(trial.false_claims)}"


def _require_success(trial: Trial) -> Iterator[str]:
    if trial.status != "succeeded":
        yield _describe_end(trial)


def _unmet_targets(trial: Trial) -> Iterator[str]:
    several = len(trial.works) > 1
    for each in list_trial_values(trial):
        if not each.metric.is_met(each.value):
            where = f"{each.subject}: " if several else ""
            yield where + _describe_unmet(each)


def _claimed_work(trial: Trial) -> Iterator[str]:
    """Yield what a trial claims to have done although an obstacle was in the way."""
    fixed = [work for work in trial.works if isinstance(work, PressingWork | InsertingWork)]
    worked = [work for work in trial.works if isinstance(work, WipingWork | PolishingWork)]
    if trial.status == "succeeded" and worked and trial.coverage is not None and trial.coverage < 1.0:
        yield f"succeeded, wanted a failure that says why: coverage {format_coverage(trial.coverage)} %"
    if trial.status == "succeeded" and fixed:
        claims = (_describe_unmet(value) for work in fixed for value in list_work_values(work))
        yield f"succeeded, wanted a failure that says why: {', '.join(claims)}"


def _describe_unmet(value: MetricValue) -> str:
    return f"{value.metric.name} {_format_value(value)} {value.metric.unit}, wanted {value.metric.target_text}"


def _format_value(value: MetricValue) -> str:
    """Return a value with three digits, or with as many as tell on which side of the target it is."""
    is_met = value.metric.is_met
    texts = (f"{value.value:.{digits}g}" for digits in range(3, 18))
    return next(text for text in texts if is_met(float(text)) is is_met(value.value))


def _safety_problems(trial: Trial) -> Iterator[str]:
    felt_n, limit_n = trial.greatest_force_n, trial.force_limit_n
    if felt_n is not None and limit_n is not None and felt_n > limit_n:
        yield f"a tool felt {felt_n:.1f} N, the limit is {limit_n:g} N"
    if not trial.at_rest:
        yield "something still moved or pushed in the end"


def _describe_end(trial: Trial) -> str:
    return f"{trial.status}: {trial.reason}" if trial.reason else trial.status
