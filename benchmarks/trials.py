"""How trials scale with processes: trials per minute with one and with all cores, and what a process costs to start.

`trials.py [TASK [COUNT]]`: COUNT trials of a task of the contact library for each number of processes, ROUNDS times.
"""

from __future__ import annotations

import os
import resource
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from statistics import median
from time import perf_counter

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_model import codec
from skillc_ontology import catalogue
from skillc_runtime.evaluation.trials.content import Experiment, prepare_runner
from skillc_runtime.evaluation.trials.dispatch import run_on

TASK, COUNT, ROUNDS = "press_button", 12, 3


@dataclass(frozen=True, slots=True)
class Series:
    """Some trials: their wall time and CPU time, in s, from the first process to the end of the last one."""

    wall_s: float
    cpu_s: float


def experiment(task: str) -> Experiment:
    """Return what is tried: a task in its own scene, undisturbed."""
    library = libraries.compile_library(find_library(SHIPPED / "contact")).value
    name = library.tasks[task].scene
    assert name is not None
    scene = catalogue.scene_path(name)
    return Experiment(
        library=codec.dumps(library), task=task, disturbance="none", scene_name=scene.name, scene=scene.read_bytes()
    )


def run(tried: Experiment, jobs: int, count: int) -> Series:
    """Run trials with seeds from 0 on, each process beginning from nothing."""
    began, used = perf_counter(), children_s()
    with ThreadPoolExecutor(jobs) as executor:
        for each in run_on(executor, partial(prepare_runner, tried), range(count)):
            assert each.trial.status == "succeeded", each
    return Series(perf_counter() - began, children_s() - used)


def children_s() -> float:
    """Return the CPU time of all processes that have ended, in s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


if __name__ == "__main__":
    asked = sys.argv[1:]
    tried, count = experiment(asked[0] if asked else TASK), int(asked[1]) if len(asked) > 1 else COUNT
    cores = os.cpu_count() or 1
    run(tried, 1, 1)  # machine code is stored
    rounds = [(run(tried, 1, 1), run(tried, 1, count), run(tried, cores, count)) for _ in range(ROUNDS)]
    each_s = median((one.cpu_s - least.cpu_s) / (count - 1) for least, one, _ in rounds)
    start_s = median(least.cpu_s - each_s for least, _, _ in rounds)
    faster = median(one.wall_s / all_.wall_s for _, one, all_ in rounds)
    dearer = median(all_.cpu_s / (one.cpu_s + (cores - 1) * start_s) for _, one, all_ in rounds)
    ideal = (start_s + count * each_s) / (start_s + count * each_s / cores)
    print(f"{count} trials in {cores} processes: {faster:.2f} times as many per minute as in one, at most {ideal:.2f}")
    print(f"They take {dearer:.2f} times the CPU time of one process and the start of the others")
    print(f"To start a process takes {start_s / each_s:.1f} times the CPU time of a trial ({each_s:.2f} s)")
