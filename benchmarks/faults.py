"""Falsifies the signals of arms in each phase of a task: what then presses on what, who notices it, and when.

`faults.py [ARM ...] [--kinds K,...] [--phases P,...]` prints a row for each fault, phase and arm: the greatest force of
any body of the arm, its hand and its tool on anything in N; after how many ms the arm stopped and for what reason; the
greatest speed of a joint half a second after that in rad/s, and the force that is left then in N.
"""

from __future__ import annotations

import argparse
import sys
from itertools import product
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

from safety.fault_trials import PHASES, WIPES, Outcome, try_fault
from skillc_runtime.backends.simulation.arms.signal_faults import KINDS


def describe(found: Outcome) -> str:
    """Return the rest of a row."""
    noticed = "never" if found.noticed_s is None else f"{1e3 * found.noticed_s:.0f} ms"
    mark = "ok " if found.is_safe else "BAD"
    figures = f"{found.force_n:8.0f} N {found.body:40.40} {noticed:>8} {found.speed_rad_s:7.3f} {found.left_n:6.1f} N"
    return f"{mark} {figures}  {found.reason:.110}"


def main() -> None:
    """Print the rows that were asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("arms", nargs="*", default=[])
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--phases", default=",".join(PHASES))
    options = parser.parse_args()
    arms, phases, kinds = options.arms or list(WIPES), options.phases.split(","), options.kinds.split(",")
    for given, known in ((arms, WIPES), (phases, PHASES), (kinds, KINDS)):
        if unknown := sorted(set(given) - set(known)):
            parser.error(f"unknown: {', '.join(unknown)}; there are: {', '.join(known)}")
    for arm, phase, kind in product(arms, phases, kinds):
        if kind.startswith("wrench") and arm != "ur5e":
            continue
        found = try_fault(arm, kind, phase)
        if found is not None:
            print(f"{arm:6} {phase:9} {kind:19} {describe(found)}", flush=True)


if __name__ == "__main__":
    main()
