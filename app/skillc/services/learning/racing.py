"""Decides after each trial of a candidate whether it is worth another one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean
from typing import Literal, TypeAlias

from skillc.services.learning.expressions import Constraint, Measure
from skillc.services.learning.figures import World
from skillc_runtime.evaluation.trials.confidence import compute_mean_interval

LEAST = 3
"""After how many trials a candidate can be found worse than another one."""

SUCCEEDS = "succeeds"
"""The constraint that every trial succeeds; it is always there."""

Verdict: TypeAlias = Literal["measured", "infeasible", "dominated"]
"""Why a candidate is tried no more: in all worlds, or in one a constraint is broken, or another one is better."""


@dataclass(frozen=True, slots=True)
class Aim:
    """What is minimised, in the mean of the trials, and what every trial has to meet besides its success."""

    objectives: tuple[Measure, ...]
    constraints: tuple[Constraint, ...] = ()

    def values_in(self, world: World) -> tuple[float, ...] | None:
        """Return the objectives (n,) of a trial; None if one was not measured."""
        values = [each.compute(world.figures) for each in self.objectives]
        known = tuple(value for value in values if value is not None)
        return known if len(known) == len(values) else None

    def violations_in(self, world: World) -> dict[str, float]:
        """Return by how much each constraint is missed in a trial, by its text, 0 if it is met.

        A trial that failed misses the one that it succeeds by 1, and those whose figures it did not measure too.
        """
        found = {SUCCEEDS: 1.0 if world.failures else 0.0}
        if not world.failures and self.values_in(world) is None:
            found[SUCCEEDS] = 1.0
        for constraint in self.constraints:
            missed = constraint.violation(world.figures)
            found[constraint.text] = 1.0 if missed is None else missed
        return found

    def mean(self, worlds: Iterable[World]) -> tuple[float, ...] | None:
        """Return the means (n,) of the objectives over the trials in which they were measured; None for none."""
        rows = [values for values in map(self.values_in, worlds) if values is not None]
        return tuple(map(fmean, zip(*rows, strict=True))) if rows else None

    def violations(self, worlds: Iterable[World]) -> dict[str, float]:
        """Return the greatest violation of each constraint over trials."""
        worst: dict[str, float] = {SUCCEEDS: 0.0, **{constraint.text: 0.0 for constraint in self.constraints}}
        for world in worlds:
            worst = {name: max(worst[name], missed) for name, missed in self.violations_in(world).items()}
        return worst

    def is_feasible(self, worlds: Iterable[World]) -> bool:
        """Whether trials meet all constraints."""
        return not any(self.violations(worlds).values())


def judge(
    aim: Aim, worlds: Mapping[int, World], seeds: Sequence[int], measured: Iterable[Mapping[int, World]]
) -> Verdict | None:
    """Return whether a candidate is done, given its trials by seed, all seeds, and the candidates that are measured.

    A candidate is dominated if after LEAST trials or more a measured one is better in all objectives in the mean of
    the differences in the same worlds, with the confidence of `compute_mean_interval`. None: it is tried further.
    """
    if not aim.is_feasible(worlds.values()):
        return "infeasible"
    if all(seed in worlds for seed in seeds):
        return "measured"
    if len(worlds) >= LEAST and any(_is_surely_better(aim, other, worlds) for other in measured):
        return "dominated"
    return None


def estimate(
    aim: Aim, worlds: Mapping[int, World], measured: Iterable[Mapping[int, World]]
) -> tuple[float, ...] | None:
    """Return the objectives (n,) of a candidate that was tried in some worlds, as they would be in all of them.

    That is the mean of a measured candidate plus the mean of the differences to it in the same worlds. None if none
    was measured in one of these.
    """
    for other in measured:
        rows, whole = _differences(aim, other, worlds), aim.mean(other.values())
        if rows and whole is not None:
            return tuple(mean + fmean(column) for mean, column in zip(whole, zip(*rows, strict=True), strict=True))
    return aim.mean(worlds.values())


def is_dominated(values: Sequence[float], others: Iterable[Sequence[float]]) -> bool:
    """Whether others have one that is nowhere worse than values (n,), and somewhere better."""
    return any(
        all(a <= b for a, b in zip(other, values, strict=True)) and tuple(other) != tuple(values) for other in others
    )


def find_front(values: Mapping[int, Sequence[float]]) -> tuple[int, ...]:
    """Return the numbers of those values (n,) that no other ones dominate, by the first objective."""
    front = [number for number, own in values.items() if not is_dominated(own, values.values())]
    return tuple(sorted(front, key=lambda number: (tuple(values[number]), number)))


def _is_surely_better(aim: Aim, other: Mapping[int, World], worlds: Mapping[int, World]) -> bool:
    rows = _differences(aim, other, worlds)
    if len(rows) < LEAST:
        return False
    intervals = (compute_mean_interval(column) for column in zip(*rows, strict=True))
    return all(interval is not None and interval.low > 0.0 for interval in intervals)


def _differences(aim: Aim, other: Mapping[int, World], worlds: Mapping[int, World]) -> list[tuple[float, ...]]:
    """Return by how much a candidate is worse than another one in each world that both know, (n,) each."""
    found = []
    for seed, world in worlds.items():
        own, others = aim.values_in(world), aim.values_in(other[seed]) if seed in other else None
        if own is not None and others is not None:
            found.append(tuple(a - b for a, b in zip(own, others, strict=True)))
    return found
