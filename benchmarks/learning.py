"""What learning finds: the hypervolume of its front against random search, and the best against the defaults.

`learning.py [REPETITIONS [CANDIDATES [TRIALS [FRESH [JOBS]]]]]`: two objectives of pressing a button, with each
sampler, and other seeds of the worlds and of the sampler in each repetition; as many candidates for both. The
hypervolume is what the front dominates below the defaults and a quarter more, as a share of that; both samplers are
compared by the rank test of Mann and Whitney. Fresh seeds compare what is proposed with the defaults.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from statistics import median
from time import process_time
from typing import NamedTuple

from scipy.stats import mannwhitneyu

from skillc.contract.learning import LearnSpec, SamplerName
from skillc.services.learning.coordinator import LearnOrder, Progress, learn
from skillc.services.learning.result import DEFAULTS, Learned
from skillc.services.reporting.reporter import SilentReporter

TASK, MINIMISE = "contact:press_button", "simulated_time, greatest_force"
SUBJECT = "held_force >= 95 %, greatest_force <= 120 %"
PARAMETERS = "PressButton.pace, Push.approach, MoveLinear.speed"
MARGIN = 1.25
"""The corner from which the hypervolume is measured, as a multiple of the objectives of the defaults."""


class Budget(NamedTuple):
    """How often it is compared, and with how much."""

    repetitions: int = 5
    candidates: int = 20
    trials: int = 2
    fresh: int = 5
    jobs: int = os.cpu_count() or 1


@contextmanager
def ignore_progress(_task: str) -> Iterator[Callable[[Progress], None]]:
    """Show nothing."""
    yield lambda state: None


def run(sampler: SamplerName, repetition: int, budget: Budget, folder: Path) -> Learned:
    """Learn once, with worlds of its own; at random only to compare the front."""
    spec = LearnSpec(
        minimise=MINIMISE,
        subject_to=SUBJECT,
        parameters=PARAMETERS,
        candidates=budget.candidates,
        trials=budget.trials,
        fresh=budget.fresh if sampler == "tpe" else 0,
        seed=1000 * repetition,
        sampler=sampler,
    )
    out = folder / f"{sampler}-{repetition}"
    request = LearnOrder(TASK, spec, out, partial(ThreadPoolExecutor, budget.jobs), budget.jobs)
    return learn(request, ignore_progress, SilentReporter())


def hypervolume(learned: Learned) -> float:
    """Return the area between the front and the corner, as a share of the corner's own; 0 for no front."""
    base = learned.candidate(DEFAULTS).objectives
    assert base is not None, "the defaults press the button"
    corner = [MARGIN * each for each in base]
    front = [each.objectives for each in map(learned.candidate, learned.front) if each.objectives is not None]
    area, height = 0.0, corner[1]
    for first, second in sorted((values[0], values[1]) for values in front):
        if first < corner[0] and second < height:
            area += (corner[0] - first) * (height - second)
            height = second
    return area / (corner[0] * corner[1])


def describe(values: Sequence[float]) -> str:
    return f"{min(values):.3f}, {median(values):.3f}, {max(values):.3f}"


if __name__ == "__main__":
    budget = Budget(*map(int, sys.argv[1:]))
    found: dict[SamplerName, list[float]] = {"tpe": [], "random": []}
    with tempfile.TemporaryDirectory() as folder:
        for repetition in range(budget.repetitions):
            for sampler, volumes in found.items():
                learned = run(sampler, repetition, budget, Path(folder))
                volumes.append(hypervolume(learned))
                tried = sum(each.trials for each in learned.candidates)
                print(f"{sampler} {repetition}: hypervolume {volumes[-1]:.3f} of {tried} trials", flush=True)
                for each in learned.fresh.objectives if learned.fresh else ():
                    print(f"  fresh seeds: {each.objective} {each.learned / each.defaults:.2f} times the defaults'")
    print(f"least, median and greatest hypervolume: {describe(found['tpe'])}, at random {describe(found['random'])}")
    test = mannwhitneyu(found["tpe"], found["random"], alternative="greater")
    print(f"Learning finds more than random search of as many candidates with p = {test.pvalue:.3f}")
    of_trials = sum(os.times()[2:4])
    print(f"The coordinator has taken {process_time():.1f} s of CPU time, the trials {of_trials:.0f} s")
