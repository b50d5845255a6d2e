"""Compares two checkouts on this machine, alternating in one run: what controlling, whole tasks and commands cost.

`python benchmarks/compare_commits.py BEFORE AFTER [TASK ...] [--rounds N]` takes folders of checkouts, or commits,
which are checked out beside this one for as long as it takes. It prints a row for each cost, with the medians of both
and of their ratios; nothing is compiled in what is measured. All takes a quarter of an hour, an hour on a busy machine.
Without tasks all are compared.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from argparse import ArgumentParser
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import TypeAlias

from control import TASKS

HERE = Path(__file__).parent
FOLDERS = ("compiler", "dsl", "ontology", "runtime", "app", "skills_src")
TABLE = ("wiping", "clean_table")
"""The task by which everything but whole tasks is compared."""

Measured: TypeAlias = dict[str, float]


@contextmanager
def checked_out(name: str) -> Iterator[Path]:
    """Yield the folder of a checkout, or of a commit that is checked out until the end of the `with` statement."""
    if Path(name).is_dir():
        yield Path(name).resolve()
        return
    with TemporaryDirectory() as folder:
        place = Path(folder) / "checkout"
        subprocess.run(("git", "worktree", "add", "--quiet", "--detach", str(place), name), cwd=HERE, check=True)
        try:
            yield place
        finally:
            subprocess.run(("git", "worktree", "remove", "--force", str(place)), cwd=HERE, check=True)


@dataclass(frozen=True)
class Pair:
    """Two checkouts to compare."""

    before: Path
    after: Path
    rounds: int

    def measure(
        self, program: str, *arguments: str, unmeasured: int = 0, **settings: str
    ) -> list[tuple[Measured, Measured]]:
        """Return what a program of this folder has measured with each checkout, alternating.

        `settings` are added to the environment; the first `unmeasured` rounds are left out.
        """
        runs = [
            (_run(self.before, program, arguments, settings), _run(self.after, program, arguments, settings))
            for _ in range(unmeasured + self.rounds)
        ]
        return runs[unmeasured:]


def _run(checkout: Path, program: str, arguments: tuple[str, ...], settings: dict[str, str]) -> Measured:
    """Run a program with the code of a checkout, in a process of its own."""
    places = [checkout / "benchmarks", *(checkout / folder for folder in FOLDERS), HERE]
    environment = {**os.environ, **settings, "PYTHONPATH": os.pathsep.join(map(str, places))}
    command = (sys.executable, "-P", str(HERE / program), *arguments)
    finished = subprocess.run(command, env=environment, capture_output=True, text=True)
    if finished.returncode:
        raise RuntimeError(f"{program} {' '.join(arguments)} of {checkout} ended with:\n{finished.stderr}")
    measured: Measured = json.loads(finished.stdout.splitlines()[-1])
    return measured


def print_row(what: str, runs: list[tuple[Measured, Measured]], cost: Callable[[Measured], float]) -> None:
    """Print the medians of a cost before and after, and that of its ratios."""
    pairs = [(cost(old), cost(new)) for old, new in runs]
    ratio = median(new / old for old, new in pairs)
    before, after = (median(pair[side] for pair in pairs) for side in (0, 1))
    print(f"{what:58} {before:9.2f} {after:9.2f} {ratio:9.3f}", flush=True)


def per_ms(run: Measured) -> float:
    """Return what a simulated ms has cost in calibration steps."""
    return 1e3 * run["cpu_s"] / run["simulated_s"] / run["calibration_us"]


def compare(pair: Pair, tasks: list[str]) -> None:
    """Print the table."""
    sliding = pair.measure("_sliding.py", *TABLE)
    print_row(
        "control period while sliding, calibration steps", sliding, lambda run: run["period_us"] / run["calibration_us"]
    )
    print_row("mj_step while sliding, calibration steps", sliding, lambda run: run["step_us"] / run["calibration_us"])
    commands = pair.measure("_command.py", TABLE[1], unmeasured=1)
    print_row("start-up of skillc run, s", commands, lambda run: run["start_s"])
    print_row("report until its page is there, s", commands, lambda run: run["report_s"])
    print_row("report with its figures, all processes, s", commands, lambda run: run["figures_s"])
    for task in tasks:
        runs = pair.measure("_whole_task.py", TASKS[task], task)
        print_row(f"{task}, per simulated ms, calibration steps", runs, per_ms)
        print_row(f"{task}, s", runs, lambda run: run["cpu_s"])
    plain = pair.measure("_whole_task.py", *TABLE, SKILLC_COMPILED="0")
    print_row(f"{TABLE[1]} without numba, s", plain, lambda run: run["cpu_s"])


def print_load(when: str) -> None:
    """Print how busy the machine is."""
    loads = " ".join(f"{each:.1f}" for each in os.getloadavg())
    print(f"load {when}: {loads} on {os.cpu_count()} cores", flush=True)


def main() -> None:
    """Compare two checkouts; without them, as when all benchmarks are run, say how that is asked for."""
    parser = ArgumentParser(description="Compare what two checkouts cost.")
    parser.add_argument("before", nargs="?")
    parser.add_argument("after", nargs="?")
    parser.add_argument("tasks", nargs="*")
    parser.add_argument("--rounds", type=int, default=3)
    asked = parser.parse_args()
    if asked.after is None:
        parser.print_help()
        return
    with checked_out(asked.before) as one, checked_out(asked.after) as other:
        print_load("at the start")
        print(f"{'CPU time':58} {'before':>9} {'after':>9} {'ratio':>9}")
        compare(Pair(one, other, asked.rounds), asked.tasks or list(TASKS))
        print_load("at the end")


if __name__ == "__main__":
    main()
