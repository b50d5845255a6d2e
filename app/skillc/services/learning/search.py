"""Asks for candidates and tries them, as many at the same time as trials are run; one after the other is judged."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from math import ceil

from skillc.services.learning.figures import World, read_world
from skillc.services.learning.racing import Aim, estimate, judge
from skillc.services.learning.result import DEFAULTS, list_measured
from skillc.services.learning.study import Candidate, Study
from skillc_runtime.evaluation.trials.dispatch import Dispatch
from skillc_runtime.evaluation.trials.hosting import Case, Prepare
from skillc_runtime.evaluation.trials.settings import Setting

MOST_OPEN = 8
"""How many candidates are tried at the same time at most: more would be asked for without what these teach."""


@dataclass(slots=True)
class Search:
    """A search of a study: `wanted` candidates, each tried with the seeds in their order, `parallel` trials at once."""

    study: Study
    aim: Aim
    seeds: Sequence[int]
    wanted: int
    parallel: int
    _given: dict[Case, Candidate] = field(default_factory=dict, init=False)

    def run(self, executor: Executor, prepare: Prepare, limit_s: float) -> Generator[Candidate, None, None]:
        """Try candidates until as many as wanted are done; yield each after each of its trials.

        ExecutorError if the executor cannot run trials. Closing the iterator gives up what is running.
        """
        for candidate in self._unfinished():  # those of whose trials the last one was recorded, and no more
            self._judge(candidate)
        with Dispatch(executor, prepare, limit_s) as dispatch:
            while True:
                self._fill(dispatch)
                if not self._given:
                    return
                case, tried = dispatch.take()
                candidate = self._given.pop(case)
                if candidate.verdict is None:
                    self.study.record(candidate, read_world(tried.trial))
                    self._judge(candidate)
                    yield candidate

    def _fill(self, dispatch: Dispatch) -> None:
        """Give trials until as many run as may: of open candidates, of further ones, then further ones of the open."""
        open_ = min(MOST_OPEN, self.parallel)
        for ahead in range(1, ceil(self.parallel / open_) + 1):
            for candidate in self._unfinished():
                self._give(dispatch, candidate, ahead)
            while (
                len(self._given) < self.parallel
                and len(self._unfinished()) < open_
                and len(self.study.candidates) < self.wanted
            ):
                self._give(dispatch, self.study.ask(), ahead)

    def _give(self, dispatch: Dispatch, candidate: Candidate, ahead: int) -> None:
        """Give the next trial of a candidate if less than `ahead` of its trials run, and there is room for it."""
        running = {case.seed for case, whose in self._given.items() if whose is candidate}
        left = [seed for seed in self.seeds if seed not in candidate.worlds and seed not in running]
        if left and len(running) < ahead and len(self._given) < self.parallel:
            case = Case(left[0], list_settings(self.study, candidate))
            if case not in self._given:
                self._given[case] = candidate
                dispatch.give(case)

    def _unfinished(self) -> list[Candidate]:
        return [each for each in self.study.candidates.values() if each.verdict is None]

    def _judge(self, candidate: Candidate) -> None:
        """Tell the study if a candidate is done. The defaults are tried in all worlds: others are compared with it."""
        measured = [each.worlds for each in list_measured(self.study.candidates).values()]
        verdict = judge(self.aim, candidate.worlds, self.seeds, measured)
        whole = all(seed in candidate.worlds for seed in self.seeds)
        if verdict is None or (candidate.number == DEFAULTS and not whole):
            return
        values = self._values(candidate.worlds, measured)
        self.study.tell(candidate, verdict, values, self.aim.violations(candidate.worlds.values()))

    def _values(self, worlds: Mapping[int, World], measured: Sequence[Mapping[int, World]]) -> tuple[float, ...]:
        """Return the objectives of a candidate; the worst ones that are known if none was measured: it has failed."""
        found = estimate(self.aim, worlds, measured) or self.study.worst_told()
        return found or tuple(0.0 for _ in self.aim.objectives)


def list_settings(study: Study, candidate: Candidate) -> tuple[Setting, ...]:
    """Return the settings of a candidate."""
    assert study.basis is not None
    pairs = zip(study.basis.learnable, candidate.values, strict=True)
    return tuple(each.set_to(value) for each, value in pairs)


def try_fresh(
    study: Study, numbers: Sequence[int], seeds: Sequence[int], parallel: int, dispatch: Dispatch
) -> Iterator[World]:
    """Try candidates with fresh seeds, all that are not recorded yet; yield each trial. Errors as of `Search.run`."""
    left = iter([(number, seed) for seed in seeds for number in numbers if seed not in study.fresh.get(number, {})])
    given: dict[Case, int] = {}
    while True:
        for number, seed in left:
            case = Case(seed, list_settings(study, study.candidates[number]))
            given[case] = number
            dispatch.give(case)
            if len(given) >= parallel:
                break
        if not given:
            return
        case, tried = dispatch.take()
        world = read_world(tried.trial)
        study.record_fresh(given.pop(case), world)
        yield world
