"""`python -m random_layouts`: judges what looks say of random layouts, and prints a table."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from judged_looks.series import judge_series
from judged_looks.verdict import format_table, share_solved, share_that_is_so
from random_layouts.drawing import KINDS
from random_layouts.judging import TILTED, judge


def main() -> int:
    """Judge the layouts and print how much of what was said is so; return 1 if too little is."""
    parser = argparse.ArgumentParser(prog="random_layouts", description=__doc__)
    parser.add_argument("--layouts", type=int, default=50, help="how many layouts of each kind")
    parser.add_argument("--seed", type=int, default=0, help="the seed of the first layout")
    parser.add_argument("--out", type=Path, default=Path("out/soak/layouts"), help="where cells and results are kept")
    options = parser.parse_args()
    wanted = [(options.seed + number, kind) for number in range(options.layouts) for kind in (*KINDS, TILTED)]
    found = judge_series(wanted, judge, options.out)
    print(format_table(found))
    print(f"{100 * share_solved(found):.1f} % of what can be done was said to go")
    return int(share_that_is_so(found, "yes") < 0.99 or share_solved(found) < 0.95)


if __name__ == "__main__":
    sys.exit(main())
