"""`python -m random_cells`: random cells in processes; cells that are recorded in the folder are not run again."""

from __future__ import annotations

import argparse
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

from random_cells.outcomes import BAD, classify, format_table
from random_cells.running import CaseRunner
from random_cells.spoiling import SERIES
from skillc_runtime.evaluation.trials import identity
from skillc_runtime.evaluation.trials.dispatch import run_on
from skillc_runtime.evaluation.trials.journal import Heading, TrialJournal, find_missing_seeds

CELL_LIMIT_S = 900.0
"""How long one cell may take, in s of wall-clock time."""


def main() -> int:
    """Run the cells, print their table; return 1 if one ended as none may."""
    options = _options()
    seeds = range(options.seed, options.seed + options.cells)
    out, draw = (options.out / options.series).absolute(), SERIES[options.series]
    heading = Heading(
        task=f"random cells, {options.series}",
        disturbance="none",
        skillc=identity.identify_skillc(),
        library=f"{options.backend}, at most {options.parts} parts",
        scene=identity.compute_digest(file.read_bytes() for file in sorted(Path(__file__).parent.glob("*.py"))),
    )
    with TrialJournal(out, heading) as journal, ThreadPoolExecutor(options.jobs) as executor:
        missing = find_missing_seeds(seeds, journal.trials)
        prepare = partial(CaseRunner, out, options.backend, options.parts, options.series)
        for trial in (tried.trial for tried in run_on(executor, prepare, missing, CELL_LIMIT_S)):
            journal.add(trial)
            said = "; ".join(trial.false_claims) if trial.is_false_success else trial.reason or ""
            print(
                f"{trial.seed}: {draw(trial.seed, 1).trouble}: {classify(trial)}: {said}", file=sys.stderr, flush=True
            )
        trials = [each for each in journal.trials if each.seed in seeds]
    print(format_table(trials, draw))
    return int(any(classify(each) in BAD for each in trials))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="random_cells", description=__doc__)
    parser.add_argument("series", nargs="?", choices=sorted(SERIES), default="spoilt", help="what is wrong with them")
    parser.add_argument("--cells", type=int, default=300, help="how many cells")
    parser.add_argument("--seed", type=int, default=0, help="the seed of the first cell")
    parser.add_argument("--parts", type=int, default=12, help="at most so many parts to move in a cell")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes")
    parser.add_argument("--backend", choices=["mujoco", "kinematic"], default="mujoco", help="what simulates them")
    parser.add_argument("--out", type=Path, default=Path("out/soak"), help="where cells and results are kept")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
