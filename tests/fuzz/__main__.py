"""`python -m fuzz KIND..`: random input of each kind; every case in which the product breaks a promise is kept."""

from __future__ import annotations

import argparse
import os
import sys
import time
from pathlib import Path

from fuzz.kinds import kind_names
from fuzz.runner import Plan, Result, run

SHOWN_LINES = 6


def main() -> int:
    """Run the kinds that were named; return 1 when something was found."""
    options = _options()
    found = 0
    for kind in options.kinds or kind_names():
        began = time.monotonic()
        plan = Plan(
            kind,
            options.seed,
            options.first,
            options.cases,
            options.jobs,
            began + 60 * options.minutes,
            options.out.absolute(),
        )
        result = run(plan, _Progress(kind))
        found += len(result.findings)
        for finding in result.findings:
            last = finding.problem.strip().splitlines()[-SHOWN_LINES:]
            again = f"python -m fuzz {kind} --seed {options.seed} --first {finding.index} --cases 1"
            print(f"{finding.folder}, again: {again}", *last, sep="\n    ")
        print(
            f"{kind}: {result.cases} cases, {len(result.findings)} findings, {time.monotonic() - began:.0f} s",
            flush=True,
        )
    return min(found, 1)


class _Progress:
    """Says now and then how far a kind is."""

    def __init__(self, kind: str, every_s: float = 10.0) -> None:
        self._kind, self._every_s, self._next = kind, every_s, time.monotonic() + every_s

    def __call__(self, result: Result) -> None:
        if time.monotonic() > self._next:
            self._next = time.monotonic() + self._every_s
            print(f"{self._kind}: {result.cases} cases, {len(result.findings)} findings", file=sys.stderr, flush=True)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="fuzz", description=__doc__)
    parser.add_argument("kinds", nargs="*", choices=[[], *kind_names()], help="what to try; everything by default")
    parser.add_argument("--seed", type=int, default=0, help="another seed makes other cases")
    parser.add_argument(
        "--first", type=int, default=0, help="number of the first case, to repeat one: --first N --cases 1"
    )
    parser.add_argument("--cases", type=int, default=1_000_000_000, help="cases of each kind, at most")
    parser.add_argument("--minutes", type=float, default=1.0, help="time for each kind, at most")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes")
    parser.add_argument("--out", type=Path, default=Path("out/fuzz"), help="where the input of findings is kept")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
