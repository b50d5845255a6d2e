"""What was learned: the candidates, the front, the one that is proposed, and how it does in worlds it has not seen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from statistics import fmean
from typing import TypeAlias

import msgspec

from skillc.errors import RequestError
from skillc.services.learning.figures import World
from skillc.services.learning.parameters import Learnable
from skillc.services.learning.racing import Aim, Verdict, find_front
from skillc.services.learning.study import Candidate
from skillc_runtime.evaluation.trials.confidence import Interval, compute_mean_interval

Candidates: TypeAlias = Mapping[int, Candidate]
"""The candidates of a study, by number."""
DEFAULTS = 0
"""The number of the candidate that has the defaults."""


class Tried(msgspec.Struct, frozen=True, kw_only=True):
    """A candidate: the values of the parameters (n,) as they are written, and what its `trials` gave.

    `objectives` are means, None for a candidate of which none was measured. `violations` are those that are not 0.
    """

    number: int
    values: tuple[str, ...]
    verdict: Verdict
    trials: int
    objectives: tuple[float, ...] | None
    violations: dict[str, float]
    failures: tuple[str, ...] = ()


class Compared(msgspec.Struct, frozen=True, kw_only=True):
    """An objective over fresh seeds: the means with the defaults and with what was learned, and their difference.

    `interval` is the confidence interval of the mean of the differences in the same worlds, None for a single one.
    """

    objective: str
    defaults: float
    learned: float
    interval: Interval | None


class Fresh(msgspec.Struct, frozen=True, kw_only=True):
    """Trials with seeds that were not used to choose: how many of them meet all constraints, and the objectives.

    `defaults_met` and `learned_met` are of all `seeds`; means are of those in which both were measured.
    """

    seeds: tuple[int, ...]
    defaults_met: int
    learned_met: int
    objectives: tuple[Compared, ...]


class Learned(msgspec.Struct, frozen=True, kw_only=True):
    """The result of a study: `front` are the numbers of candidates that no other one dominates.

    The candidate 0 has the defaults. `complete` is whether all was tried that was asked for. `chosen` is the one that
    is proposed; None if nothing is better than the defaults. `importances` are for each objective the shares of the
    parameters. `diff` is the change of the texts, `recordings` are the folders of recorded runs, by what they show.
    """

    task: str
    scene: str
    minimise: tuple[str, ...]
    subject_to: tuple[str, ...]
    parameters: tuple[Learnable, ...]
    seeds: tuple[int, ...]
    wanted: int
    candidates: tuple[Tried, ...]
    front: tuple[int, ...]
    chosen: int | None
    importances: dict[str, dict[str, float]]
    fresh: Fresh | None = None
    complete: bool = False
    diff: str = ""
    applied: bool = False
    recordings: dict[str, str] = {}

    @property
    def is_confirmed(self) -> bool:
        """Whether a candidate is proposed with which no fewer fresh trials meet all constraints than with defaults."""
        return self.chosen is not None and (self.fresh is None or self.fresh.learned_met >= self.fresh.defaults_met)

    def candidate(self, number: int) -> Tried:
        """Return a candidate by its number."""
        return next(each for each in self.candidates if each.number == number)


def list_measured(candidates: Candidates) -> dict[int, Candidate]:
    """Return the candidates that were tried in all worlds and met all constraints, by number."""
    return {number: each for number, each in candidates.items() if each.verdict == "measured"}


def list_front(candidates: Candidates, aim: Aim) -> tuple[int, ...]:
    """Return the numbers of the measured candidates that no other one dominates."""
    return find_front(_means(candidates, aim))


def choose(candidates: Candidates, aim: Aim, asked: int | None = None) -> int | None:
    """Return the number of the candidate that is proposed: of the front, that with the least mean of the objectives.

    These are differences to the defaults, each as a share of the spread of the measured candidates. Where the defaults
    meet the constraints, only candidates count that are not worse than them in any objective, as long as there are
    such. None if there is no front, or it is the defaults. RequestError for one asked for that was not measured.
    """
    means = _means(candidates, aim)
    if asked is not None:
        if asked not in means:
            raise RequestError(f"--take {asked}: there is no such candidate that met all constraints in all trials")
        return asked
    if not means:
        return None
    same = candidates[DEFAULTS].values
    front = [number for number in find_front(means) if candidates[number].values != same]
    if not front:
        return None
    base = means.get(DEFAULTS)
    not_worse = [each for each in front if base is None or all(a <= b for a, b in zip(means[each], base, strict=True))]
    columns = list(zip(*means.values(), strict=True))
    spreads = [(max(column) - min(column)) or 1.0 for column in columns]

    def cost(number: int) -> float:
        return fmean(value / spread for value, spread in zip(means[number], spreads, strict=True))

    best = min(not_worse or front, key=cost)
    return best if base is None or not_worse or cost(best) < cost(DEFAULTS) else None


def describe_candidates(candidates: Candidates, learnable: Sequence[Learnable], aim: Aim) -> tuple[Tried, ...]:
    """Return the candidates that are tried no more."""
    return tuple(
        Tried(
            number=each.number,
            values=write_values(learnable, each.values),
            verdict=each.verdict,
            trials=len(each.worlds),
            objectives=aim.mean(each.worlds.values()),
            violations={name: missed for name, missed in aim.violations(each.worlds.values()).items() if missed},
            failures=tuple(dict.fromkeys(why for world in each.worlds.values() for why in world.failures)),
        )
        for each in candidates.values()
        if each.verdict is not None
    )


def write_values(learnable: Sequence[Learnable], values: Sequence[float]) -> tuple[str, ...]:
    """Return values (n,) as they are written in texts."""
    return tuple(each.write(value) for each, value in zip(learnable, values, strict=True))


def compare_fresh(aim: Aim, defaults: Mapping[int, World], learned: Mapping[int, World]) -> Fresh | None:
    """Return how what was learned compares with the defaults in worlds that both know; None if there is none."""
    seeds = tuple(seed for seed in defaults if seed in learned)
    if not seeds:
        return None
    rows = [(aim.values_in(defaults[seed]), aim.values_in(learned[seed])) for seed in seeds]
    both = [(before, after) for before, after in rows if before is not None and after is not None]
    return Fresh(
        seeds=seeds,
        defaults_met=sum(aim.is_feasible([defaults[seed]]) for seed in seeds),
        learned_met=sum(aim.is_feasible([learned[seed]]) for seed in seeds),
        objectives=tuple(
            Compared(
                objective=objective.text,
                defaults=fmean(before[index] for before, _ in both),
                learned=fmean(after[index] for _, after in both),
                interval=compute_mean_interval([after[index] - before[index] for before, after in both]),
            )
            for index, objective in enumerate(aim.objectives)
            if both
        ),
    )


def _means(candidates: Candidates, aim: Aim) -> dict[int, tuple[float, ...]]:
    found = {number: aim.mean(each.worlds.values()) for number, each in list_measured(candidates).items()}
    return {number: values for number, values in found.items() if values is not None}
