"""`python -m random_surfaces`: judges what looks say of random surfaces, and prints a table."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from judged_looks.series import judge_series
from judged_looks.verdict import format_table, share_that_is_so
from random_surfaces.drawing import ARM_NAMES
from random_surfaces.judging import judge


def main() -> int:
    """Judge the surfaces and print how much of what was said is so; return 1 if too little is."""
    parser = argparse.ArgumentParser(prog="random_surfaces", description=__doc__)
    parser.add_argument("--surfaces", type=int, default=200, help="how many surfaces for each arm")
    parser.add_argument("--seed", type=int, default=0, help="the seed of the first surface")
    parser.add_argument("--out", type=Path, default=Path("out/soak/surfaces"), help="where scenes and results are kept")
    options = parser.parse_args()
    wanted = [(options.seed + number, arm) for number in range(options.surfaces) for arm in ARM_NAMES]
    found = judge_series(wanted, judge, options.out)
    print(format_table(found))
    return int(share_that_is_so(found, "yes") < 0.99 or share_that_is_so(found, "no") < 0.98)


if __name__ == "__main__":
    sys.exit(main())
