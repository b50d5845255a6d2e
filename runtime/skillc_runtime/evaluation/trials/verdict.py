"""Whether a trial went as it should: undisturbed it meets every target, disturbed it recovers or gives up safely."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from skillc_runtime.evaluation.measures.work import InsertingWork, PolishingWork, PressingWork, WipingWork
from skillc_runtime.evaluation.trials.targets import MetricValue, metric_values, work_values
from skillc_runtime.evaluation.trials.trial import Disturbance, Trial


def find_misses(trial: Trial, disturbance: Disturbance) -> tuple[str, ...]:
    """Return why a trial is not as it should be, in words; nothing for one that is."""
    if trial.status in ("refused", "crashed"):
        return (_ended(trial),)
    return (*_unlike(trial, disturbance), *_unsafe(trial))


def _unlike(trial: Trial, disturbance: Disturbance) -> Iterator[str]:
    """Yield what should have become of the task and did not."""
    match disturbance:
        case "none":
            yield from _unsuccessful(trial)
            yield from _off_target(trial)
        case "push":
            if not trial.pushed:
                yield "there was no push: nothing is done along a path or in a search"
            yield from _unsuccessful(trial)
            if trial.coverage < 1.0:
                yield f"coverage {100 * trial.coverage:.1f} %, wanted 100 % in the end"
        case "missing":
            if trial.status != "failure" or not trial.reason:
                yield f"{trial.status}, wanted a failure that says why"
        case "obstacle":
            yield from _untrue(trial)
        case _:
            assert_never(disturbance)


def _unsuccessful(trial: Trial) -> Iterator[str]:
    if trial.status != "success":
        yield _ended(trial)


def _off_target(trial: Trial) -> Iterator[str]:
    several = len(trial.works) > 1
    for each in metric_values(trial):
        if not each.metric.met(each.value):
            where = f"{each.subject}: " if several else ""
            yield where + _missed(each)


def _untrue(trial: Trial) -> Iterator[str]:
    """Yield what a trial claims to have done where something was in the way."""
    fixed = [work for work in trial.works if isinstance(work, PressingWork | InsertingWork)]
    worked = [work for work in trial.works if isinstance(work, WipingWork | PolishingWork)]
    if trial.status == "success" and worked and trial.coverage < 1.0:
        yield f"success, wanted a failure that says why: coverage {100 * trial.coverage:.1f} %"
    if trial.status == "success" and fixed:
        yield f"success, wanted a failure that says why: {', '.join(_missed(v) for w in fixed for v in work_values(w))}"


def _missed(value: MetricValue) -> str:
    return f"{value.metric.name} {value.value:.3g} {value.metric.unit}, wanted {value.metric.wanted}"


def _unsafe(trial: Trial) -> Iterator[str]:
    if trial.force_limit_n is not None and trial.greatest_force_n > trial.force_limit_n:
        yield f"a tool felt {trial.greatest_force_n:.1f} N, the limit is {trial.force_limit_n:g} N"
    if not trial.at_rest:
        yield "something still moved or pushed in the end"


def _ended(trial: Trial) -> str:
    return f"{trial.status}: {trial.reason}" if trial.reason else trial.status
