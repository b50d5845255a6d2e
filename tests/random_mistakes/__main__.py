"""`python -m random_mistakes`: random mistakes in shipped and in other libraries, and how many errors each gives."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from functools import partial
from multiprocessing import Pool

from random_mistakes.judging import ORIGINS, Verdict, judge

TARGETS = {1: 0.98, 2: 0.93, 3: 0.93}
"""The least share of cases with as many errors as mistakes, by the number of mistakes."""
NEAR = 0.97
"""The least share of single mistakes with an error on their line or the next, or one that points there."""


def main() -> int:
    """Print the shares, and to stderr what is not as it should be; return 1 if a target is missed or a case crashes."""
    options = _options()
    seeds = range(options.seed, options.seed + options.edits)
    good = True
    print("libraries mistakes  cases   exact   fewer    near   alone  fixes   useless crashes")
    with Pool(options.jobs) as pool:
        for origin in options.libraries:
            for count in options.counts:
                verdicts = []
                for each in pool.imap_unordered(partial(judge, origin, count=count), seeds, chunksize=5):
                    if each is not None:
                        verdicts.append(each)
                        _show(each)
                print(_row(origin, count, verdicts), flush=True)
                good = good and _is_good(count, verdicts)
    return int(not good)


def _row(origin: str, count: int, verdicts: Sequence[Verdict]) -> str:
    total = max(1, len(verdicts))
    shares = (
        sum(each.is_exact for each in verdicts) / total,
        sum(each.errors < each.mistakes for each in verdicts) / total,
        sum(each.is_near for each in verdicts) / total,
        sum(each.is_exact and not each.warnings for each in verdicts) / total,
    )
    crashes = sum(bool(each.crash) for each in verdicts)
    fixes, bad = (sum(each) for each in zip(*((each.fixes, each.useless_fixes) for each in verdicts), strict=True))
    shown = " ".join(f"{share:7.2%}" for share in shares)
    return f"{origin:9} {count:8} {len(verdicts):6} {shown} {fixes:6} {bad:9} {crashes:7}"


def _show(each: Verdict) -> None:
    """Print to stderr what is not as it should be: E the number of errors, N places, W warnings."""
    flags = (
        ("-", "E")[not each.is_exact],
        ("-", "N")[not each.is_near],
        ("-", "W")[each.warnings > 0],
    )
    if each.crash:
        print(f"crash {each.words}\n{each.crash}", file=sys.stderr, flush=True)
    elif "".join(flags) != "---":
        print(f"{each.mistakes} {''.join(flags)} {each.words}", file=sys.stderr, flush=True)


def _is_good(count: int, verdicts: Sequence[Verdict]) -> bool:
    right = sum(each.is_exact for each in verdicts)
    near = sum(each.is_near for each in verdicts)
    is_enough = right >= TARGETS[count] * len(verdicts) and (count > 1 or near >= NEAR * len(verdicts))
    return is_enough and not any(each.crash for each in verdicts)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="random_mistakes", description=__doc__)
    parser.add_argument("--edits", type=int, default=1000, help="how many cases for each row of the table")
    parser.add_argument("--seed", type=int, default=0, help="the seed of the first case")
    parser.add_argument("--counts", type=int, nargs="+", default=list(TARGETS), choices=TARGETS, help="mistakes each")
    parser.add_argument("--libraries", nargs="+", default=list(ORIGINS), choices=ORIGINS, help="where they are made")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
