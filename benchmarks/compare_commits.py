"""Compares whole tasks of two checkouts on this machine, alternating in one run: CPU time after start-up.

`python benchmarks/compare_commits.py BEFORE AFTER [TASK ...]` takes folders of checkouts, or commits, which are checked
out beside this one for as long as it takes. It prints the medians and their ratio; a calibration step is timed with
each run.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from control import TASKS

HERE = Path(__file__).parent
FOLDERS = ("compiler", "dsl", "ontology", "runtime", "app", "skills_src")
ROUNDS = 3


@contextmanager
def checked_out(name: str) -> Iterator[Path]:
    """Yield the folder of a checkout, or of a commit that is checked out until the end of the `with` statement."""
    if Path(name).is_dir():
        yield Path(name).resolve()
        return
    with TemporaryDirectory() as folder:
        place = Path(folder) / "checkout"
        subprocess.run(("git", "worktree", "add", "--detach", str(place), name), cwd=HERE, check=True)
        try:
            yield place
        finally:
            subprocess.run(("git", "worktree", "remove", "--force", str(place)), cwd=HERE, check=True)


def run_once(checkout: Path, library: str, task: str) -> dict[str, float]:
    """Run a task with the code of a checkout, in a process of its own."""
    path = os.pathsep.join(str(checkout / folder) for folder in FOLDERS)
    finished = subprocess.run(
        (sys.executable, str(HERE / "_whole_task.py"), library, task),
        env={**os.environ, "PYTHONPATH": path},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    measured: dict[str, float] = json.loads(finished.stdout.splitlines()[-1])
    return measured


def cost(run: dict[str, float]) -> float:
    """Return what a simulated ms has cost in calibration steps."""
    return 1e3 * run["cpu_s"] / run["simulated_s"] / run["calibration_us"]


def compare(before: Path, after: Path, task: str) -> None:
    """Print a row for a task."""
    runs = [(run_once(before, TASKS[task], task), run_once(after, TASKS[task], task)) for _ in range(ROUNDS)]
    ratio = median(new["cpu_s"] / old["cpu_s"] for old, new in runs)
    old, new = (median(cost(pair[side]) for pair in runs) for side in (0, 1))
    print(f"{task:18} {old:10.2f} {new:10.2f} {ratio:10.3f}")


if __name__ == "__main__":
    with checked_out(sys.argv[1]) as one, checked_out(sys.argv[2]) as other:
        print(f"{'task':18} {'before':>10} {'after':>10} {'CPU':>10}   calibration steps per simulated ms; ratio")
        for name in sys.argv[3:] or TASKS:
            compare(one, other, name)
