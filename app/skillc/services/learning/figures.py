"""The figures of trials by name, for objectives and constraints."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from typing import Any

import msgspec

from skillc.errors import RequestError
from skillc_runtime.evaluation.trials.targets import METRICS, RUNNING, Metric, list_trial_values
from skillc_runtime.evaluation.trials.trial import Trial
from skillc_runtime.evaluation.trials.verdict import find_failures

_NO_LETTER = re.compile(r"[^a-z0-9]+")


class World(msgspec.Struct, frozen=True, kw_only=True):
    """A trial of a candidate: its seed, the figures that were measured, and why it failed; empty if it succeeded.

    A figure of several things is the worst of theirs. `variation` is how reality differed from the world model.
    """

    seed: int
    figures: dict[str, float]
    failures: tuple[str, ...] = ()
    variation: str = ""


def read_world(trial: Trial) -> World:
    """Return what counts of a trial."""
    figures: dict[str, float] = {}
    for each in list_trial_values(trial):
        name = name_figure(each.metric)
        worst = max if each.metric.sense == "at-most" else min
        figures[name] = worst(figures.get(name, each.value), each.value)
    return World(seed=trial.seed, figures=figures, failures=find_failures(trial), variation=trial.variation)


def name_figure(metric: Metric[Any]) -> str:
    """Return the name of a metric in expressions: `force RMSE` is `force_rmse`."""
    return _NO_LETTER.sub("_", metric.name.lower()).strip("_")


@dataclass(frozen=True, slots=True)
class Figures:
    """The figures that expressions may name, with the units of each."""

    units: Mapping[str, frozenset[str]]

    def find(self, name: str) -> str:
        """Return the figure of a name, which may be its last words if these are of one figure only: `impact`.

        RequestError for any other name, which lists the figures that there are.
        """
        fitting = self._fitting(name)
        if len(fitting) == 1:
            return fitting[0]
        if fitting:
            raise RequestError(f"`{name}` may be {' or '.join(f'`{each}`' for each in fitting)}: name one of them")
        near = get_close_matches(name, self.units, n=1)
        hint = f"; did you mean `{near[0]}`?" if near else ";"
        raise RequestError(f"there is no figure `{name}`{hint} the figures are {self.listed}")

    def require(self, name: str) -> str:
        """Return one of the figures of a name, whichever. RequestError if there is none."""
        return next(iter(self._fitting(name)), None) or self.find(name)

    @property
    def listed(self) -> str:
        """The figures as a text, for messages."""
        return ", ".join(f"`{each}`" for each in sorted(self.units))

    def _fitting(self, name: str) -> list[str]:
        return [name] if name in self.units else sorted(each for each in self.units if each.endswith(f"_{name}"))


@cache
def all_figures() -> Figures:
    """Return the figures that trials of some task measure; some kinds of work measure one in a unit of their own."""
    return _collect(metric for metrics in (*METRICS.values(), RUNNING) for metric in metrics)


def measured_figures(trial: Trial) -> Figures:
    """Return the figures that a trial has measured."""
    return _collect(each.metric for each in list_trial_values(trial))


def _collect(metrics: Iterable[Metric[Any]]) -> Figures:
    found: dict[str, set[str]] = {}
    for metric in metrics:
        found.setdefault(name_figure(metric), set()).add(metric.unit)
    return Figures({name: frozenset(units) for name, units in found.items()})
