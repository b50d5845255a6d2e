"""How trials scale with processes: trials per minute with one and with all cores, and what a process costs to start.

`trials.py [TASK [COUNT]]`: COUNT trials of a task of the contact library for each number of processes.
"""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from functools import partial
from time import perf_counter

from skillc.services import libraries
from skillc.services.library_files import SHIPPED, find_library
from skillc_model import codec
from skillc_ontology import catalogue
from skillc_runtime.evaluation.trials.experiment import Experiment, TrialRunner
from skillc_runtime.evaluation.trials.workers import run_in_processes

TASK, COUNT = "press_button", 4


@dataclass(frozen=True, slots=True)
class Series:
    """Some trials in a number of processes: how many per minute, and the share of a process's time to start it."""

    jobs: int
    per_minute: float
    start_share: float


def experiment(task: str) -> Experiment:
    """Return what is tried: a task in its own scene, undisturbed."""
    library = libraries.compile_library(find_library(SHIPPED / "contact")).value
    scene = library.tasks[task].scene
    assert scene is not None
    return Experiment(codec.dumps(library), task, catalogue.scene_path(scene), "none")


def run(tried: Experiment, jobs: int, count: int) -> Series:
    """Run trials with seeds from 0 on, each process beginning from nothing."""
    began, first = perf_counter(), 0.0
    for trial in run_in_processes(partial(TrialRunner, tried), range(count), jobs):
        assert trial.status == "succeeded", trial
        first = first or perf_counter() - began - trial.wall_time_s
    took = perf_counter() - began
    return Series(jobs, 60 * count / took, first / took)


if __name__ == "__main__":
    asked = sys.argv[1:]
    tried, count = experiment(asked[0] if asked else TASK), int(asked[1]) if len(asked) > 1 else COUNT
    series = [run(tried, jobs, count) for jobs in sorted({1, os.cpu_count() or 1})]
    for each in series:
        ratio = each.per_minute / series[0].per_minute
        print(
            f"{each.jobs} processes: {ratio:.2f} x as many trials per minute as one ({each.per_minute:.1f}); "
            f"starting takes {each.start_share:.0%} of the time of {count} trials"
        )
